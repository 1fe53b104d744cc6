#pragma once

#include <string>

namespace dipper {

/// "0.1.0+g8e9f758", ".dirty" after it where files differ from that commit; "0.1.0" from a tarball.
std::string version();

}  // namespace dipper
