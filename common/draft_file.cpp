#include "common/draft_file.hpp"

#include <unistd.h>

#include <string>
#include <utility>

namespace dipper {

namespace fs = std::filesystem;

DraftFile::DraftFile(fs::path file) : file_(std::move(file)) {
  if (fs::is_symlink(file_)) file_ = fs::weakly_canonical(file_);
  path_ = file_;
  const fs::file_status now = fs::status(file_);
  if (fs::exists(now) && !fs::is_regular_file(now) && !fs::is_directory(now)) return;
  path_.replace_extension(".part" + std::to_string(getpid()) + file_.extension().string());
}

DraftFile::~DraftFile() {
  std::error_code ignored;
  if (path_ != file_) fs::remove(path_, ignored);
}

bool is_draft(const fs::path& file) {
  return file.stem().extension().string().rfind(".part", 0) == 0;
}

}  // namespace dipper
