#include "coupler/run/drive_limits_met.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "common/record/record.hpp"

namespace dipper::run {

DriveLimitsMet drive_limits_met(const std::filesystem::path& record) {
  const auto time_s = record::read_channel(record, "time_s");
  const auto channel = [&](const std::string& name) {
    auto values = record::read_channel(record, "machine/" + name);
    values.resize(time_s.size());
    return values;
  };
  const auto time_at_one = [&](const std::string& name) {
    const auto flag = channel(name);
    double sum_s = 0;
    for (std::size_t i = 1; i < flag.size(); ++i) sum_s += flag[i] * (time_s[i] - time_s[i - 1]);
    return sum_s;
  };
  DriveLimitsMet met;
  if (time_s.empty()) return met;
  met.path_time_s = channel("path_time").back();
  met.late_s = time_s.back() - met.path_time_s;
  met.hoist_saturated_s = time_at_one("hoist_saturated");
  met.crowd_saturated_s = time_at_one("crowd_saturated");
  met.swing_saturated_s = time_at_one("swing_saturated");
  met.ropes_slack_s = time_at_one("ropes_slack");
  const auto relief = channel("crowd_relief");
  met.crowd_relief_most_m = *std::max_element(relief.begin(), relief.end());
  return met;
}

}  // namespace dipper::run
