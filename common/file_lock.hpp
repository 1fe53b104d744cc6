// One process at a time.
#pragma once

#include <filesystem>
#include <optional>

namespace dipper {

/// A lock on a file of its own, which is made for it and gone with it. The kernel drops it with the
/// process, however that ends; the file that a killed process leaves keeps nobody out.
/// A file system without locks (Lustre without -o flock, NFS without lockd) has a file FILE.held in
/// their place, which names host and process: what a process killed on this host leaves keeps
/// nobody out either.
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
  bool make_held();

  std::filesystem::path file_;
  std::filesystem::path
      held_;  ///< where the file system has no locks: a file that only one can make
  int fd_ = -1;
};

}  // namespace dipper
