#include "common/temporary_folder.hpp"

#include <stdlib.h>

#include <cerrno>
#include <system_error>

namespace dipper {

TemporaryFolder::TemporaryFolder(const std::string& name) {
  std::string made = (std::filesystem::temp_directory_path() / (name + "-XXXXXX")).string();
  if (mkdtemp(made.data()) == nullptr)
    throw std::system_error(errno, std::generic_category(), "cannot make " + made);
  path_ = made;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace dipper
