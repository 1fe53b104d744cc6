#pragma once

#include <string>
#include <vector>

namespace dipper::cli {

/// `dipper gap` and the like: becomes a Python program of analysis/, as `python3 -m package`, which
/// reads `words` itself. Returns only when that cannot be started; throws std::runtime_error.
int python_command(const std::string& package, const std::vector<std::string>& words);

}  // namespace dipper::cli
