#include "analysis/report/record_curves.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/record/record.hpp"

namespace dipper::analysis::report {

void read_curves(const std::filesystem::path& record, bool limited_drives, ReportInput& input) {
  static constexpr std::pair<const char*, const char*> kChannels[] = {
      {"machine/hoist_force", "N"},      {"machine/crowd_force", "N"},
      {"machine/hoist_power", "W"},      {"machine/crowd_power", "W"},
      {"machine/swing_power", "W"},      {"rock/mass_in_dipper", "kg"},
      {"rock/mass_in_truck", "kg"},      {"coupling/rock_work", "J"},
      {"coupling/energy_residual", "J"}, {"sync_s", "s"},
  };
  static constexpr std::pair<const char*, const char*> kOfLimitedDrives[] = {
      {"machine/crowd_relief", "m"},
      {"machine/hoist_saturated", "1"},
      {"machine/crowd_saturated", "1"},
      {"machine/swing_saturated", "1"},
  };
  input.time_s = record::read_channel(record, "time_s");
  for (const auto& [name, unit] : kChannels) {
    input.curves.push_back({name, unit, record::read_channel(record, name)});
  }
  if (limited_drives) {
    for (const auto& [name, unit] : kOfLimitedDrives)
      input.curves.push_back({name, unit, record::read_channel(record, name)});
    ReportCurve late{"late", "s", record::read_channel(record, "machine/path_time")};
    const std::size_t rows = std::min(late.values.size(), input.time_s.size());
    for (std::size_t i = 0; i < rows; ++i) late.values[i] = input.time_s[i] - late.values[i];
    input.curves.push_back(std::move(late));
  }
  // A run under way may have flushed one dataset and not yet the next.
  for (auto& c : input.curves) {
    if (c.values.size() < input.time_s.size()) input.time_s.resize(c.values.size());
  }
  for (auto& c : input.curves) c.values.resize(input.time_s.size());
  ReportCurve dig{"dig_force", "N", {}};
  for (std::size_t i = 0; i < input.time_s.size(); ++i) {
    dig.values.push_back(std::hypot(input.curves[0].values[i], input.curves[1].values[i]));
  }
  input.curves.push_back(std::move(dig));
}

}  // namespace dipper::analysis::report
