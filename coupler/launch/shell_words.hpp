#pragma once

#include <string>
#include <vector>

namespace dipper::launch {

/// Words of a text, quoted as for a shell; none of a text of blanks. Throws InputError that names
/// `option` for quotes that do not match.
std::vector<std::string> shell_words(const std::string& text, const std::string& option);

}  // namespace dipper::launch
