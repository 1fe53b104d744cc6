#include "coupler/result/drive_limits_met.hpp"

#include <fmt/format.h>

#include "analysis/metrics/drive_limits.hpp"
#include "common/record/record.hpp"

namespace dipper::result {

void report_drives(const cases::Case& c, const std::filesystem::path& record,
                   nlohmann::ordered_json& summary, Reporter& reporter) {
  if (c.machine.drives != machine::DriveMode::limited) return;
  const auto path_s = record::read_channel(record, "machine/path_time");
  if (path_s.empty()) return;
  const analysis::metrics::LimitsMet met = analysis::metrics::DriveLimits(record).over_all();
  auto& drives = summary["drives"] = {{"path_time_s", path_s.back()}};
  drives.update(analysis::metrics::json_of(met));
  reporter.line(fmt::format(
      "drives: {:.1f} s late; at their limit for {:.1f} s (hoist), {:.1f} s (crowd), {:.1f} s "
      "(swing); the operator let the crowd back by up to {:.2f} m",
      met.late_s, met.hoist_saturated_s, met.crowd_saturated_s, met.swing_saturated_s,
      met.crowd_relief_most_m));
}

}  // namespace dipper::result
