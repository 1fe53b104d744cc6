// Warnings from the libraries to the user.
#pragma once

#include <string>

namespace dipper {

/// Reports something unexpected that is not an error: "dipper: MESSAGE" on standard error.
void warn(const std::string& message);

}  // namespace dipper
