// Figures of limited drives at their limits (docs/drives.md).
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "analysis/signals/phases.hpp"
#include "common/record/columns.hpp"

namespace dipper::analysis::metrics {

/// Over a part of a run.
struct LimitsMet {
  double hoist_saturated_s = 0, crowd_saturated_s = 0, swing_saturated_s = 0;  ///< at the limit
  double ropes_slack_s = 0;
  double late_s = 0;               ///< by which the machine fell behind the motion
  double crowd_relief_most_m = 0;  ///< largest retraction of the crowd's set point
};

/// The keys of summary.json and metrics.json.
nlohmann::ordered_json json_of(const LimitsMet& met);

/// A record of a run with limited drives.
class DriveLimits {
 public:
  /// Throws std::runtime_error naming file and dataset.
  explicit DriveLimits(const std::filesystem::path& record);

  LimitsMet over(const signals::TimeSpan& time) const;
  LimitsMet over_all() const;

 private:
  record::Columns columns_;
};

}  // namespace dipper::analysis::metrics
