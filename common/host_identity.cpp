#include "common/host_identity.hpp"

#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace dipper {

std::string host_name() {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

std::string network_identity() {
  std::string boot;
  std::ifstream("/proc/sys/kernel/random/boot_id") >> boot;  // random(4)
  std::error_code unknown;
  return boot + " " + std::filesystem::read_symlink("/proc/self/ns/net", unknown).string();
}

}  // namespace dipper
