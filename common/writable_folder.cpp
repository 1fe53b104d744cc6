#include "common/writable_folder.hpp"

#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "common/input_error.hpp"

namespace dipper {

void make_writable(const std::filesystem::path& folder) {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (!failed && access(folder.c_str(), W_OK | X_OK) == 0) return;
  if (!failed) failed = std::error_code(errno, std::generic_category());
  throw InputError(
      {{folder, 0, "", "cannot be written (" + failed.message() + "); choose another --out"}});
}

}  // namespace dipper
