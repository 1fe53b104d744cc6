#include "analysis/report/record_curves.hpp"

#include <cmath>
#include <utility>

#include "common/record/record.hpp"

namespace dipper::analysis::report {

void read_curves(const std::filesystem::path& record, ReportInput& input) {
  static constexpr std::pair<const char*, const char*> kChannels[] = {
      {"machine/hoist_force", "N"},      {"machine/crowd_force", "N"},
      {"machine/hoist_power", "W"},      {"machine/crowd_power", "W"},
      {"machine/swing_power", "W"},      {"rock/mass_in_dipper", "kg"},
      {"rock/mass_in_truck", "kg"},      {"coupling/rock_work", "J"},
      {"coupling/energy_residual", "J"}, {"sync_s", "s"},
  };
  input.time_s = record::read_channel(record, "time_s");
  for (const auto& [name, unit] : kChannels) {
    input.curves.push_back({name, unit, record::read_channel(record, name)});
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
