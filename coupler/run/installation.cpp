#include "coupler/run/installation.hpp"

#include <cstdlib>

namespace dipper {

namespace fs = std::filesystem;

std::string program(const std::string& name) {
  return (fs::read_symlink("/proc/self/exe").parent_path() / name).string();
}

fs::path source_folder() { return DIPPER_SOURCE_FOLDER; }

fs::path cache_folder() {
  if (const char* xdg = std::getenv("XDG_CACHE_HOME"); xdg != nullptr && *xdg != '\0') {
    return fs::path(xdg) / "dipper";
  }
  const char* home = std::getenv("HOME");
  return fs::path(home != nullptr ? home : "/tmp") / ".cache" / "dipper";
}

std::string version() { return DIPPER_VERSION; }

}  // namespace dipper
