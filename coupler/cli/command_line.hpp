#pragma once

#include <string>
#include <vector>

#include "common/reporter.hpp"

namespace dipper::cli {

/// Runs `dipper WORDS` and returns its exit status. Throws InputError, and what the command throws.
int command_line(std::vector<std::string> words, Reporter& reporter);

}  // namespace dipper::cli
