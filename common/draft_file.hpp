// A file that appears whole or not at all.
#pragma once

#include <filesystem>
#include <system_error>

namespace dipper {

/// A draft beside a file, NAME.partPID.EXTENSION, to write to: keep() renames it to the file, and
/// it is removed otherwise. For a link it is beside the link's target; a device is its own draft.
class DraftFile {
 public:
  explicit DraftFile(std::filesystem::path file);
  ~DraftFile();
  DraftFile(const DraftFile&) = delete;
  DraftFile& operator=(const DraftFile&) = delete;

  const std::filesystem::path& path() const { return path_; }

  /// Throws std::filesystem::filesystem_error; the second returns the error in `failed`.
  void keep() const { std::filesystem::rename(path_, file_); }
  void keep(std::error_code& failed) const { std::filesystem::rename(path_, file_, failed); }

 private:
  std::filesystem::path file_, path_;
};

/// Whether a file's name is one that DraftFile writes to.
bool is_draft(const std::filesystem::path& file);

}  // namespace dipper
