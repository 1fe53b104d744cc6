#include "coupler/launch/installation.hpp"

namespace dipper::launch {

namespace fs = std::filesystem;

std::string program(const std::string& name) {
  return (fs::read_symlink("/proc/self/exe").parent_path() / name).string();
}

fs::path source_folder() { return DIPPER_SOURCE_FOLDER; }

std::string version() { return DIPPER_VERSION; }

}  // namespace dipper::launch
