#include "analysis/metrics/drive_limits.hpp"

#include <algorithm>
#include <limits>

namespace dipper::analysis::metrics {

nlohmann::ordered_json json_of(const LimitsMet& met) {
  return {{"late_s", met.late_s},
          {"hoist_saturated_s", met.hoist_saturated_s},
          {"crowd_saturated_s", met.crowd_saturated_s},
          {"swing_saturated_s", met.swing_saturated_s},
          {"ropes_slack_s", met.ropes_slack_s},
          {"crowd_relief_most_m", met.crowd_relief_most_m}};
}

DriveLimits::DriveLimits(const std::filesystem::path& record) : columns_(record) {
  for (const char* channel :
       {"time_s", "machine/path_time", "machine/hoist_saturated", "machine/crowd_saturated",
        "machine/swing_saturated", "machine/ropes_slack", "machine/crowd_relief"})
    columns_.read(channel);
}

LimitsMet DriveLimits::over(const signals::TimeSpan& time) const {
  const auto time_s = columns_.get("time_s"), path_s = columns_.get("machine/path_time");
  // The rows in the interval, and the one before it, from which the first one lasts.
  const auto row_after = [&](double at_s) {
    return static_cast<std::size_t>(std::upper_bound(time_s.begin(), time_s.end(), at_s) -
                                    time_s.begin());
  };
  const std::size_t begin = std::max<std::size_t>(row_after(time.t_start_s), 1),
                    end = row_after(time.t_end_s);
  LimitsMet met;
  if (begin >= end) return met;
  const auto time_at_one = [&](const char* channel) {
    const auto flag = columns_.get(channel);
    double sum_s = 0;
    for (std::size_t i = begin; i < end; ++i) sum_s += flag[i] * (time_s[i] - time_s[i - 1]);
    return sum_s;
  };
  met.hoist_saturated_s = time_at_one("machine/hoist_saturated");
  met.crowd_saturated_s = time_at_one("machine/crowd_saturated");
  met.swing_saturated_s = time_at_one("machine/swing_saturated");
  met.ropes_slack_s = time_at_one("machine/ropes_slack");
  met.late_s = (time_s[end - 1] - path_s[end - 1]) - (time_s[begin - 1] - path_s[begin - 1]);
  const auto relief = columns_.get("machine/crowd_relief");
  for (std::size_t i = begin; i < end; ++i)
    met.crowd_relief_most_m = std::max(met.crowd_relief_most_m, relief[i]);
  return met;
}

LimitsMet DriveLimits::over_all() const {
  constexpr double kEver_s = std::numeric_limits<double>::infinity();
  return over({-kEver_s, kEver_s});
}

}  // namespace dipper::analysis::metrics
