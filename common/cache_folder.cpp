#include "common/cache_folder.hpp"

#include "common/input_error.hpp"

namespace dipper {
namespace {

std::filesystem::path& folder() {
  static std::filesystem::path path;
  return path;
}

}  // namespace

std::filesystem::path cache_folder() {
  if (folder().empty())
    throw InputError({{"", 0, "",
                       "no place for settled piles and fitted rocks: neither XDG_CACHE_HOME nor "
                       "HOME is set; set XDG_CACHE_HOME to a folder for them"}});
  return folder();
}

void set_cache_folder(const std::filesystem::path& path) { folder() = path; }

}  // namespace dipper
