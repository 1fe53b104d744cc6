// --set KEY=VALUE, which most commands take.
#pragma once

#include <string>
#include <vector>

#include "coupler/case/case.hpp"

namespace dipper::cli {

/// \param example  of a --set that suits the command, for the message
/// Throws CLI::ValidationError for a text without "=".
std::vector<cases::Override> overrides_of(const std::vector<std::string>& set,
                                          const std::string& example);

}  // namespace dipper::cli
