// The shovel's channels at the end of a window.
#pragma once

#include <vector>

#include "coupler/core/server.hpp"
#include "mbs/operator.hpp"

namespace dipper::mbs {

/// In the order of a MachineState's channels. `from`: the operator, whose channels and those of the
/// drives' limits are added; none: the drives are prescribed.
std::vector<core::Channel> shovel_channels(const Operator* from);

}  // namespace dipper::mbs
