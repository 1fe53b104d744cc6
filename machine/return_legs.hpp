// The times in which a motion returns the dipper from the truck to the face.
#pragma once

#include <cstdint>
#include <vector>

#include "machine/motion.hpp"

namespace dipper::machine {

struct ReturnLeg {
  std::int64_t begin_ns;  ///< the door, having been open, begins to close
  std::int64_t end_ns;    ///< the crowd is all in, the next dig begins; or the motion ends
};

/// One leg for every time the door opens (door.hpp) and closes again, in order. The end is the last
/// time at which the crowd is within 1 mm of its least before it is furthest out, in the next dig.
/// Empty when the door does not move.
std::vector<ReturnLeg> return_legs(const Motion& motion);

}  // namespace dipper::machine
