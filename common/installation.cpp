#include "common/installation.hpp"

#include <unistd.h>

#include <cstdlib>
#include <sstream>

#include "common/input_error.hpp"

namespace dipper {

namespace fs = std::filesystem;

namespace {

fs::path own_folder() { return fs::read_symlink("/proc/self/exe").parent_path(); }

fs::path& given_folder() {
  static fs::path path;
  return path;
}

}  // namespace

std::string installed_program(const std::string& name) {
  const fs::path beside = own_folder() / name;
  return fs::exists(beside) ? beside : own_folder().parent_path() / "libexec" / "dipper" / name;
}

std::string found_on_path(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    const std::string file = fs::path(folder) / name;
    if (access(file.c_str(), X_OK) == 0) return file;
  }
  return name;
}

fs::path data_folder() {
  const fs::path folder =
      given_folder().empty() ? own_folder().parent_path() / "share" / "dipper" : given_folder();
  std::error_code failed;
  // In the build tree it is a link to the repository; messages and logs name the files themselves.
  fs::path found = fs::canonical(folder, failed);
  if (failed || !fs::is_directory(found / "dem_in")) {
    throw InputError({{folder, 0, "",
                       "has no dem_in, so Dipper's own files are missing; set DIPPER_DATA to the "
                       "folder that has them (PREFIX/share/dipper of an installation)"}});
  }
  return found;
}

void set_data_folder(const fs::path& folder) { given_folder() = folder; }

}  // namespace dipper
