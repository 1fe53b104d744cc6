// Checks that a machine's dimensions fit together, for any motion.
#pragma once

#include <string>
#include <vector>

#include "machine/machine_data.hpp"

namespace dipper::machine {

/// The faults, one sentence per cause with the key and the figures; empty when the loop from drum
/// over sheave, bail, handle and saddle block closes with the ropes taut at every crowd for some
/// hoist within the limits, and hoisting lifts. Of faults that follow from each other only the
/// first.
///
/// \param rake handle's centre line to dipper's floor, rad
std::vector<std::string> geometry_faults(const MachineData& machine, double rake);

}  // namespace dipper::machine
