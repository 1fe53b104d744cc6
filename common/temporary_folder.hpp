// A folder for temporary files.
#pragma once

#include <filesystem>
#include <string>

namespace dipper {

/// A new folder where the system keeps temporary files, removed with its contents at the end of
/// this object's lifetime.
class TemporaryFolder {
 public:
  /// The folder's name begins with `name`, so that one left by a kill can be recognised. Throws
  /// std::system_error naming the folder that cannot be made.
  explicit TemporaryFolder(const std::string& name);
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace dipper
