// Words to the user from the libraries.
#pragma once

#include <string>

namespace dipper {

/// Tells of something that went another way than planned, though not wrong: "dipper: MESSAGE" on
/// the standard error.
void warn(const std::string& message);

}  // namespace dipper
