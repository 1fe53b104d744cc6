#include "common/resolved_path.hpp"

#include "common/input_error.hpp"

namespace dipper {

namespace fs = std::filesystem;

fs::path resolved(const fs::path& path) {
  if (path.empty()) throw InputError({{{}, 0, "", "no case is given: its name is empty"}});
  fs::path whole = fs::absolute(path);
  if (!whole.has_filename()) whole = whole.parent_path();  // a slash at the end
  const fs::path name = whole.filename();
  std::error_code failed;  // links in a circle: opening it says so
  const bool is_name = !name.empty() && name != "." && name != "..";
  const fs::path found = fs::weakly_canonical(is_name ? whole.parent_path() : whole, failed);
  if (failed) return whole.lexically_normal();
  return is_name ? found / name : found;
}

}  // namespace dipper
