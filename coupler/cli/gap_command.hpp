#pragma once

#include <string>
#include <vector>

namespace dipper::cli {

/// `dipper gap`: becomes the Python program in analysis/gap, which reads `words` itself. Returns
/// only when that cannot be started; throws std::runtime_error.
int gap_command(const std::vector<std::string>& words);

}  // namespace dipper::cli
