#include "coupler/result/drive_limits_met.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "common/record/record.hpp"

namespace dipper::result {

void tell_drives(const cases::Case& c, const std::filesystem::path& record,
                 nlohmann::ordered_json& summary, Reporter& reporter) {
  if (c.machine.drives != machine::DriveMode::limited) return;
  const auto time_s = record::read_channel(record, "time_s");
  if (time_s.empty()) return;
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
  const double path_time_s = channel("path_time").back(), late_s = time_s.back() - path_time_s;
  const double hoist_s = time_at_one("hoist_saturated"), crowd_s = time_at_one("crowd_saturated"),
               swing_s = time_at_one("swing_saturated");
  const auto relief = channel("crowd_relief");
  const double relief_most_m = *std::max_element(relief.begin(), relief.end());
  summary["drives"] = {
      {"path_time_s", path_time_s},          {"late_s", late_s},
      {"hoist_saturated_s", hoist_s},        {"crowd_saturated_s", crowd_s},
      {"swing_saturated_s", swing_s},        {"ropes_slack_s", time_at_one("ropes_slack")},
      {"crowd_relief_most_m", relief_most_m}};
  reporter.line(fmt::format(
      "drives: {:.1f} s late; at their limit for {:.1f} s (hoist), {:.1f} s (crowd), {:.1f} s "
      "(swing); the crowd let back by {:.2f} m at most",
      late_s, hoist_s, crowd_s, swing_s, relief_most_m));
}

}  // namespace dipper::result
