// The angles at which the dipper's door is shut and open.
#pragma once

#include <cmath>

namespace dipper::machine {

/// More than about 1 degree, which is more than a drive's ripple; closed at 0.
inline bool door_is_open(double door_rad) { return std::abs(door_rad) > 0.02; }

/// Shut, and held by its latch: at larger angles it is opening, and carries no weight.
inline bool door_is_latched(double door_rad) { return std::abs(door_rad) <= 1e-5; }

}  // namespace dipper::machine
