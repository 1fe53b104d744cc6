#include "common/file_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <fstream>
#include <system_error>

namespace dipper {

FileLock::~FileLock() {
  if (fd_ < 0) return;
  unlink(file_.c_str());  // while it is still ours; see try_lock
  close(fd_);
}

bool FileLock::try_lock() {
  const int fd = open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (fd < 0) throw std::system_error(errno, std::generic_category(), file_.string());
  if (flock(fd, LOCK_EX | LOCK_NB) != 0) {
    const int why = errno;
    close(fd);
    if (why == EWOULDBLOCK || why == EINTR) return false;
    throw std::system_error(why, std::generic_category(), file_.string());
  }
  // The last owner may have removed the file between our opening and locking it: a lock on a file
  // without a name keeps nobody out.
  struct stat held {
  }, named{};
  if (fstat(fd, &held) != 0 || stat(file_.c_str(), &named) != 0 || held.st_ino != named.st_ino) {
    close(fd);
    return false;
  }
  fd_ = fd;
  if (ftruncate(fd_, 0) == 0) dprintf(fd_, "%d\n", getpid());  // a name for owner(), no more
  return true;
}

std::optional<long> FileLock::owner() const {
  std::ifstream in(file_);
  long pid = 0;
  return in >> pid ? std::optional(pid) : std::nullopt;
}

}  // namespace dipper
