// Whether a machine's dimensions can be put together at all, whatever it is told to do.
#pragma once

#include <string>
#include <vector>

#include "machine/machine_data.hpp"

namespace dipper::machine {

/// What is wrong, one sentence a cause with the key and the figures; empty when the loop from drum
/// over sheave, bail, handle and saddle block closes with the ropes taut at every crowd for some
/// hoist within the limits, and hoisting lifts. The first that is found of causes which follow from
/// each other.
///
/// \param rake handle's centre line to dipper's floor, rad
std::vector<std::string> geometry_faults(const MachineData& machine, double rake);

}  // namespace dipper::machine
