// A lock between processes.
#pragma once

#include <filesystem>
#include <optional>

namespace dipper {

/// A lock on a file of its own, which is made and removed with it. The kernel releases it when the
/// process ends in any way; the file that a killed process leaves blocks nobody.
/// On a file system without locks (Lustre without -o flock, NFS without lockd) a file FILE.held,
/// which names host and process, replaces the lock; one left by a process killed on this host
/// blocks nobody either.
class FileLock {
 public:
  explicit FileLock(std::filesystem::path file) : file_(std::move(file)) {}
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;
  ~FileLock();

  /// Takes the lock unless another holds it. Throws std::system_error naming the file.
  bool try_lock();

  /// The process that holds the lock, if the file names it.
  std::optional<long> owner() const;

 private:
  bool make_held();

  std::filesystem::path file_;
  std::filesystem::path
      held_;  ///< where the file system has no locks: a file that only one process can make
  int fd_ = -1;
};

}  // namespace dipper
