#include "coupler/cli/output_file.hpp"

#include <unistd.h>

#include <system_error>

#include "common/input_error.hpp"
#include "coupler/case/case_hash.hpp"

namespace dipper::cli {

namespace fs = std::filesystem;

void require_place(const fs::path& file, const std::string& remedy) {
  const fs::path parent = fs::absolute(file).parent_path();
  if (fs::is_directory(parent) && access(parent.c_str(), W_OK | X_OK) == 0) return;
  throw InputError({{parent, 0, "", "cannot be written into; " + remedy}});
}

void require_output(const fs::path& file, const std::string& option,
                    const std::vector<fs::path>& inputs) {
  const auto refuse = [&](const std::string& why) {
    throw InputError({{file, 0, option, why + "; name another file"}});
  };
  if (fs::is_directory(file)) refuse("is a folder");
  std::error_code not_there;
  for (const fs::path& input : inputs)
    if (fs::equivalent(file, input, not_there)) refuse("is an input, which would be lost");
  const bool is_device = fs::exists(file) && !fs::is_regular_file(file);  // written to as it is
  if (!is_device) require_place(file, "choose another " + option);
}

std::vector<fs::path> inputs_of(const cases::Case& c) {
  std::vector<fs::path> files = cases::referenced_files(c);
  files.push_back(c.folder / "case.yaml");
  return files;
}

}  // namespace dipper::cli
