#include "analysis/report/dry_page.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/report/page.hpp"
#include "analysis/report/record_replay.hpp"
#include "analysis/report/replay_blocks.hpp"
#include "analysis/report/replay_json.hpp"
#include "analysis/report/report_page.hpp"
#include "common/input_error.hpp"
#include "common/json_text.hpp"
#include "common/record/columns.hpp"
#include "common/text_file.hpp"

namespace dipper::analysis::report {
namespace {

namespace fs = std::filesystem;
using json = nlohmann::json;

constexpr double kLineStep_m = 0.4, kLineRadius_m = 0.06;
constexpr double kWayStep_m = 0.05;  // between points of the path of the teeth

/// The teeth's path in the plane of the boom in each pass: from its start until the door opens.
json ways(const json& summary, const record::Columns& record) {
  const auto time_s = record.get("time_s"), x = record.get("rock/teeth_x"),
             y = record.get("rock/teeth_y"), z = record.get("rock/teeth_z");
  const double base_x = summary.at("base_m").at(0), base_y = summary.at("base_m").at(1);
  json out = json::array();
  for (const json& pass : summary.at("passes")) {
    json way = {{"pass", pass.at("pass")}, {"out_m", json::array()}, {"up_m", json::array()}};
    double last_out = 1e300, last_up = 1e300;
    for (std::size_t i = 0; i < time_s.size(); ++i) {
      if (time_s[i] < pass.at("t_start_s") || time_s[i] > pass.at("t_dump_s")) continue;
      const double out_m = std::hypot(x[i] - base_x, y[i] - base_y);
      if (std::hypot(out_m - last_out, z[i] - last_up) < kWayStep_m) continue;
      way["out_m"].push_back(rounded(last_out = out_m, 1e3));
      way["up_m"].push_back(rounded(last_up = z[i], 1e3));
    }
    out.push_back(std::move(way));
  }
  return out;
}

/// The machine over the bench, and a line for each pass where the teeth go.
ReplayBlocks at_work(const run::RunData& run, const json& passes, const record::Columns& record) {
  const auto time_s = record.get("time_s"), x = record.get("rock/teeth_x"),
             y = record.get("rock/teeth_y"), z = record.get("rock/teeth_z");
  run::Figure figure = run::read_figure(run);
  for (const json& pass : passes) {
    std::vector<Vector3d> way;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const Vector3d tip(x[i], y[i], z[i]);
      if (time_s[i] < pass.at("t_start_s") || time_s[i] > pass.at("t_end_s")) continue;
      if (way.empty() || (tip - way.back()).norm() > kLineStep_m) way.push_back(tip);
    }
    figure.ropes.push_back({kLineRadius_m, [way](double) { return way; }, pass.at("pass")});
  }
  ReplayBlocks replay = encode_replay(RecordReplay(run));
  replay.head["figure"] = json_of_figure(figure, replay.head["times_s"]);
  return replay;
}

}  // namespace

bool is_dry_run(const fs::path& folder) {
  const json summary = read_json_or_discard(folder / "summary.json");
  return summary.is_object() && summary.contains("rock_model");
}

void write_dry_page(const fs::path& folder, const fs::path& file) {
  const json summary = read_json_or_discard(folder / "summary.json");
  static constexpr std::pair<const char*, const char*> kChannels[] = {
      {"machine/hoist_force", "N"}, {"machine/crowd_force", "N"},  {"machine/hoist_power", "W"},
      {"machine/crowd_power", "W"}, {"machine/swing_power", "W"},  {"machine/hoist", "m"},
      {"machine/crowd", "m"},       {"rock/mass_in_dipper", "kg"}, {"rock/cut_depth", "m"},
  };
  try {
    record::Columns record(folder / "record.h5");
    for (const char* name : {"time_s", "rock/teeth_x", "rock/teeth_y", "rock/teeth_z"})
      record.read(name);
    for (const auto& channel : kChannels) record.read(channel.first);
    ReportInput input;
    input.time_s = record.get("time_s");
    for (const auto& [name, unit] : kChannels)
      input.curves.push_back({name, unit, record.get(name)});
    const run::RunData run = run::read_run_folder(folder);
    ReplayBlocks replay = at_work(run, summary.at("passes"), record);
    const std::string title = fs::weakly_canonical(folder).filename().string();
    write_text(file, page({{"kind", "dry"},
                           {"title", title},
                           {"summary", summary},
                           {"curves", curves_json(input)},
                           {"ways", ways(summary, record)},
                           {"replay", std::move(replay.head)}},
                          replay.blocks));
  } catch (const json::exception& e) {
    throw InputError({{folder / "summary.json", 0, "", e.what()}});
  }
}

}  // namespace dipper::analysis::report
