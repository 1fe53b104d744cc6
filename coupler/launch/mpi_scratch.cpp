#include "coupler/launch/mpi_scratch.hpp"

#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>

namespace dipper::launch {
namespace fs = std::filesystem;
namespace {

// Each rank takes 4 MB. When it is full, MPI waits forever; containers have 64 MB.
constexpr std::uintmax_t kLeastShared_B = 48'000'000;

bool is_own_folder(const fs::path& folder) {
  struct stat s {};
  return lstat(folder.c_str(), &s) == 0 && S_ISDIR(s.st_mode) && s.st_uid == geteuid();
}

/// "PREFIXpid-letters" of a process that has ended; our own pid counts too, as a dead one had it.
bool is_left_behind(const std::string& name, const std::string& prefix) {
  if (name.rfind(prefix, 0) != 0) return false;
  const long pid = std::strtol(name.c_str() + prefix.size(), nullptr, 10);
  if (pid <= 0) return false;
  return pid == getpid() || (kill(static_cast<pid_t>(pid), 0) != 0 && errno == ESRCH);
}

class Scratch {
 public:
  Scratch() {
    std::error_code ignored;
    const fs::path memory = "/dev/shm";  // Open MPI's default for shared memory
    const auto room = fs::space(memory, ignored);
    const bool fits = !ignored && room.available >= kLeastShared_B;
    const fs::path root =
        fits && access(memory.c_str(), W_OK) == 0 ? memory : fs::temp_directory_path();
    const std::string prefix = fmt::format("dipper-mpi-{}-", geteuid());
    for (const auto& entry : fs::directory_iterator(root, ignored)) {
      if (is_left_behind(entry.path().filename().string(), prefix) && is_own_folder(entry.path())) {
        fs::remove_all(entry.path(), ignored);
      }
    }
    std::string name = (root / fmt::format("{}{}-XXXXXX", prefix, getpid())).string();
    if (mkdtemp(name.data()) == nullptr) {
      throw std::runtime_error("cannot make " + name + ": " + std::strerror(errno));
    }
    folder = name;
  }
  ~Scratch() {
    if (getpid() != owner_) return;  // a child's copy
    std::error_code ignored;
    fs::remove_all(folder, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  fs::path folder;

 private:
  pid_t owner_ = getpid();
};

}  // namespace

const fs::path& mpi_scratch() {
  static const Scratch scratch;
  return scratch.folder;
}

}  // namespace dipper::launch
