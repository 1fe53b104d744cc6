#include "common/file_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <string>
#include <system_error>

#include "common/host_identity.hpp"

namespace dipper {
namespace {

/// Whether flock's error says that the file system has no locks. The Python commands know the same
/// (dipper_run/run_cache.py).
bool has_no_locks(int error) {
  return error == ENOSYS || error == ENOLCK || error == EOPNOTSUPP || error == EINVAL;
}

}  // namespace

FileLock::~FileLock() {
  if (fd_ < 0) return;
  unlink(file_.c_str());  // while it is still ours; see try_lock
  if (!held_.empty()) unlink(held_.c_str());
  close(fd_);
}

bool FileLock::try_lock() {
  const int fd = open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (fd < 0) throw std::system_error(errno, std::generic_category(), file_.string());
  if (flock(fd, LOCK_EX | LOCK_NB) != 0) {
    const int why = errno;
    if (has_no_locks(why)) {
      fd_ = fd;
      if (make_held()) return true;
      fd_ = -1;
      close(fd);
      return false;
    }
    close(fd);
    if (why == EWOULDBLOCK || why == EINTR) return false;
    throw std::system_error(why, std::generic_category(), file_.string());
  }
  // The last owner may have removed the file between our opening and locking it: a lock on a file
  // without a name excludes nobody.
  struct stat held {
  }, named{};
  if (fstat(fd, &held) != 0 || stat(file_.c_str(), &named) != 0 || held.st_ino != named.st_ino) {
    close(fd);
    return false;
  }
  fd_ = fd;
  if (ftruncate(fd_, 0) == 0) dprintf(fd_, "%d\n", getpid());  // for owner() only
  return true;
}

bool FileLock::make_held() {
  const std::filesystem::path held = file_.string() + ".held";
  for (int tries = 0; tries < 2; ++tries) {
    const int made = open(held.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (made >= 0) {
      const bool written = dprintf(made, "%s %d\n", host_name().c_str(), getpid()) > 0;
      if (close(made) != 0 || !written)
        throw std::system_error(errno, std::generic_category(), held.string());
      held_ = held;
      if (ftruncate(fd_, 0) == 0) dprintf(fd_, "%d\n", getpid());
      return true;
    }
    if (errno != EEXIST) throw std::system_error(errno, std::generic_category(), held.string());
    std::string host;
    pid_t pid = 0;
    std::ifstream(held) >> host >> pid;
    const bool is_dead = host == host_name() && pid > 0 && kill(pid, 0) != 0 && errno == ESRCH;
    if (!is_dead) return false;
    unlink(held.c_str());
  }
  return false;
}

std::optional<long> FileLock::owner() const {
  std::ifstream in(file_);
  long pid = 0;
  return in >> pid ? std::optional(pid) : std::nullopt;
}

}  // namespace dipper
