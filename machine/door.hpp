// The angle from which the dipper's door counts as open.
#pragma once

#include <cmath>

namespace dipper::machine {

/// More than about 1 degree, which is more than a drive's ripple; closed at 0.
inline bool door_is_open(double door_rad) { return std::abs(door_rad) > 0.02; }

}  // namespace dipper::machine
