// The drives' signals over time.
#pragma once

#include <vector>

namespace dipper::analysis::signals {

/// One entry for each sync step, all of the same length; unused forces and powers may be empty.
struct DriveSignals {
  std::vector<double> time_s;  ///< ends of the sync steps, increasing
  std::vector<double> hoist_m;
  std::vector<double> crowd_m;    ///< larger: further out
  std::vector<double> swing_rad;  ///< either direction
  std::vector<double> hoist_force_N, crowd_force_N;
  std::vector<double> hoist_power_W{}, crowd_power_W{}, swing_power_W{};  ///< into the machine
};

}  // namespace dipper::analysis::signals
