// What the teeth sweep of the bench's nominal surface, before any rock moves.
#pragma once

#include <vector>

#include "coupler/check/warning_parts.hpp"

namespace dipper::check {

struct DigSweep {
  double volume_m3 = 0;  ///< over the dipper's inner width
  double deepest_m = 0;  ///< of the cut
  bool first = true;     ///< in its lane
  bool lean = false;     ///< the first in its lane, and too little to fill the dipper
};

/// One entry a dig of the parts' motion.
std::vector<DigSweep> dig_sweeps(const CaseParts& parts);

}  // namespace dipper::check
