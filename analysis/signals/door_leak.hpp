// A door that leaks: part of each load is lost between the face and the truck.
#pragma once

#include <vector>

#include "analysis/signals/drive_signals.hpp"
#include "analysis/signals/passes.hpp"
#include "analysis/signals/payload_monitor.hpp"

namespace dipper::analysis::signals {

/// Takes off the drives what the lost rock would have weighed: of each load nothing at the start of
/// breakout, then more in proportion to time, and `share` of it from the dump on; by statics
/// (PayloadMonitor::holding_of_a_kg). The dipper moves as before.
void leak(double share, const PassSignals& s, const std::vector<Pass>& passes,
          const PayloadMonitor& monitor, DriveSignals& drives);

}  // namespace dipper::analysis::signals
