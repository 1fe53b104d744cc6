// The drives over time.
#pragma once

#include <vector>

namespace dipper::analysis::signals {

/// One entry a sync step, all of the same length; a force or power may be left empty where nobody
/// reads it.
struct DriveSignals {
  std::vector<double> time_s;  ///< ends of the sync steps, rising
  std::vector<double> hoist_m;
  std::vector<double> crowd_m;    ///< out: larger
  std::vector<double> swing_rad;  ///< either way
  std::vector<double> hoist_force_N, crowd_force_N;
  std::vector<double> hoist_power_W{}, crowd_power_W{}, swing_power_W{};  ///< into the machine
};

}  // namespace dipper::analysis::signals
