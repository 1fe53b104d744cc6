// A leaking door: part of each load is lost between the face and the truck.
#pragma once

#include <vector>

#include "analysis/signals/drive_signals.hpp"
#include "analysis/signals/passes.hpp"
#include "analysis/signals/payload_monitor.hpp"

namespace dipper::analysis::signals {

/// Subtracts from the drives' forces the weight of the lost rock: of each load nothing at the start
/// of breakout, then in proportion to time, and `share` of it from the dump on; by statics
/// (PayloadMonitor::holding_of_a_kg). The dipper's motion does not change.
void leak(double share, const PassSignals& s, const std::vector<Pass>& passes,
          const PayloadMonitor& monitor, DriveSignals& drives);

}  // namespace dipper::analysis::signals
