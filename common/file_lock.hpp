// One process at a time.
#pragma once

#include <filesystem>
#include <optional>

namespace dipper {

/// A lock on a file of its own, which is made for it and gone with it. The kernel drops it with the
/// process, however that ends; the file that a killed process leaves keeps nobody out.
class FileLock {
 public:
  explicit FileLock(std::filesystem::path file) : file_(std::move(file)) {}
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;
  ~FileLock();

  /// Takes the lock unless another holds it. Throws std::system_error naming the file.
  bool try_lock();

  /// The process that holds the lock, as far as the file tells.
  std::optional<long> owner() const;

 private:
  std::filesystem::path file_;
  int fd_ = -1;
};

}  // namespace dipper
