// What the teeth sweep of the bench's nominal surface, before any rock moves.
#pragma once

#include <vector>

#include "coupler/case/case.hpp"
#include "machine/machine_data.hpp"
#include "machine/motion.hpp"

namespace dipper::check {

struct DigSweep {
  double volume_m3 = 0;  ///< over the dipper's inner width
  double deepest_m = 0;  ///< of the cut
  bool first = true;     ///< in its lane
  bool lean = false;     ///< the first in its lane, and too little to fill the dipper
};

/// One entry a dig of the motion.
std::vector<DigSweep> dig_sweeps(const cases::Case& c, const machine::MachineData& machine,
                                 const machine::Motion& motion);

}  // namespace dipper::check
