#include "coupler/cli/environment.hpp"

#include <cstdlib>
#include <filesystem>
#include <string>

#include "common/cache_folder.hpp"
#include "common/installation.hpp"

namespace dipper::cli {
namespace {

std::filesystem::path variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

}  // namespace

void read_environment() {
  const std::filesystem::path cache = variable("XDG_CACHE_HOME"), home = variable("HOME");
  if (!cache.empty()) {
    set_cache_folder(cache / "dipper");
  } else if (!home.empty()) {
    set_cache_folder(home / ".cache" / "dipper");
  }
  if (const auto data = variable("DIPPER_DATA"); !data.empty()) set_data_folder(data);
}

}  // namespace dipper::cli
