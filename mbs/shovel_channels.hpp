// What the shovel tells of itself at the end of a window.
#pragma once

#include <vector>

#include "coupler/core/server.hpp"

namespace dipper::mbs {

/// In the order of a MachineState's channels. `limited`: with what limited drives add.
std::vector<core::Channel> shovel_channels(bool limited);

}  // namespace dipper::mbs
