// How often limited drives were at their limits, and how late that made the machine.
#pragma once

#include <filesystem>

namespace dipper::run {

/// Over a whole run.
struct DriveLimitsMet {
  double path_time_s = 0;  ///< of the motion, where the run ended
  double late_s = 0;       ///< the run's end less that
  double hoist_saturated_s = 0, crowd_saturated_s = 0, swing_saturated_s = 0;
  double ropes_slack_s = 0;
  double crowd_relief_most_m = 0;  ///< by which the operator let the crowd back
};

/// Of the record of a run with limited drives (docs/drives.md). Throws std::runtime_error naming
/// file and dataset.
DriveLimitsMet drive_limits_met(const std::filesystem::path& record);

}  // namespace dipper::run
