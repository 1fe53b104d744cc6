// A path as a word of a shell's command.
#pragma once

#include <filesystem>
#include <string>

namespace dipper {

/// In quotes where a shell would take the path apart or as something else.
std::string shell_word(const std::filesystem::path& path);

}  // namespace dipper
