#include "common/writable_folder.hpp"

#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "common/input_error.hpp"

namespace dipper {
namespace {

bool can_write_into(const std::filesystem::path& folder) {
  return access(folder.c_str(), W_OK | X_OK) == 0;
}

[[noreturn]] void refuse(const std::filesystem::path& folder, const std::string& why,
                         const std::string& remedy = "choose another --out") {
  throw InputError({{folder, 0, "", "cannot be written (" + why + "); " + remedy}});
}

}  // namespace

void make_writable(const std::filesystem::path& folder, const std::string& remedy) {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (!failed && can_write_into(folder)) return;
  if (!failed) failed = std::error_code(errno, std::generic_category());
  refuse(folder, failed.message(), remedy);
}

void require_writable(const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  std::error_code unknown;
  fs::path nearest = fs::absolute(folder);
  while (!fs::exists(fs::symlink_status(nearest, unknown)) && nearest.has_relative_path())
    nearest = nearest.parent_path();
  if (!fs::is_directory(nearest, unknown)) refuse(folder, nearest.string() + " is not a folder");
  if (!can_write_into(nearest))
    refuse(folder, std::error_code(errno, std::generic_category()).message());
}

}  // namespace dipper
