// The shovel's channels at the end of a window.
#pragma once

#include <vector>

#include "coupler/core/server.hpp"

namespace dipper::mbs {

/// In the order of a MachineState's channels. `limited`: with those of limited drives.
std::vector<core::Channel> shovel_channels(bool limited);

}  // namespace dipper::mbs
