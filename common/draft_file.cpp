#include "common/draft_file.hpp"

#include <unistd.h>

#include <string>
#include <utility>

namespace dipper {

DraftFile::DraftFile(std::filesystem::path file) : file_(std::move(file)), path_(file_) {
  path_.replace_extension(".part" + std::to_string(getpid()) + file_.extension().string());
}

DraftFile::~DraftFile() {
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

}  // namespace dipper
