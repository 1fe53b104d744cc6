// A folder for what is needed only while something is done.
#pragma once

#include <filesystem>
#include <string>

namespace dipper {

/// A new folder of our own where the system keeps temporary files, gone with all that is in it
/// when this is.
class TemporaryFolder {
 public:
  /// `name` begins the folder's, for who finds it after a kill. Throws std::system_error naming the
  /// folder that cannot be made.
  explicit TemporaryFolder(const std::string& name);
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace dipper
