#include "analysis/report/record_curves.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/record/record.hpp"

namespace dipper::analysis::report {
namespace {

namespace fs = std::filesystem;
using Columns = std::vector<std::pair<const char*, const char*>>;  // name, unit

void read(const fs::path& record, const Columns& channels, ReportInput& input) {
  for (const auto& [name, unit] : channels)
    input.curves.push_back({name, unit, record::read_channel(record, name)});
}

/// Times at which limited drives are at their limit, and their delay.
void read_limits(const fs::path& record, ReportInput& input) {
  read(record,
       {{"machine/crowd_relief", "m"},
        {"machine/hoist_saturated", "1"},
        {"machine/crowd_saturated", "1"},
        {"machine/swing_saturated", "1"}},
       input);
  ReportCurve late{"late", "s", record::read_channel(record, "machine/path_time")};
  const std::size_t rows = std::min(late.values.size(), input.time_s.size());
  for (std::size_t i = 0; i < rows; ++i) late.values[i] = input.time_s[i] - late.values[i];
  input.curves.push_back(std::move(late));
}

/// The length of a vector whose parts are columns.
ReportCurve length(std::string name, const std::vector<std::vector<double>>& parts) {
  ReportCurve curve{std::move(name), "N", {}};
  for (std::size_t i = 0; i < parts.front().size(); ++i) {
    double sum = 0;
    for (const auto& part : parts) sum += i < part.size() ? part[i] * part[i] : 0;
    curve.values.push_back(std::sqrt(sum));
  }
  return curve;
}

}  // namespace

void read_curves(const run::RunData& run, ReportInput& input) {
  const fs::path record = run.folder / "record.h5";
  input.time_s = record::read_channel(record, "time_s");
  if (run.is_shovel) {
    read(record,
         {{"machine/hoist_force", "N"},
          {"machine/crowd_force", "N"},
          {"machine/hoist_power", "W"},
          {"machine/crowd_power", "W"},
          {"machine/swing_power", "W"},
          {"rock/mass_in_dipper", "kg"},
          {"rock/mass_in_truck", "kg"}},
         input);
    input.curves.push_back(length("dig_force", {input.curves[0].values, input.curves[1].values}));
    if (run.text("machine.drives") == "limited") read_limits(record, input);
  } else {
    for (const std::string& channel : run.masses)
      input.curves.push_back(
          {"rock/" + channel, "kg", record::read_channel(record, "rock/" + channel)});
    for (const auto& track : run.signals.walls) {
      std::vector<std::vector<double>> parts;
      for (const std::size_t k : {3, 4, 5})
        parts.push_back(record::read_channel(record, "bodies/" + track.first + "/wrench_mean", k));
      input.curves.push_back(length("force/" + track.first, parts));
    }
  }
  read(record, {{"coupling/rock_work", "J"}, {"coupling/energy_residual", "J"}, {"sync_s", "s"}},
       input);
  // A run under way may have flushed one dataset and not yet the next.
  for (const auto& c : input.curves)
    if (c.values.size() < input.time_s.size()) input.time_s.resize(c.values.size());
  for (auto& c : input.curves) c.values.resize(input.time_s.size());
}

}  // namespace dipper::analysis::report
