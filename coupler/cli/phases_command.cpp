#include "coupler/cli/phases_command.hpp"

#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "analysis/run/run_folder.hpp"
#include "analysis/signals/drive_terms.hpp"
#include "analysis/signals/pass_phases.hpp"
#include "analysis/signals/passes.hpp"
#include "common/input_error.hpp"
#include "common/json_text.hpp"
#include "common/manifest.hpp"

namespace dipper::cli {
namespace {

namespace signals = analysis::signals;
using json = nlohmann::ordered_json;

json list(const std::vector<signals::Phase>& phases) {
  json out = json::array();
  for (const signals::Phase& p : phases)
    out.push_back({{"phase", word(p.name)}, {"t_start_s", p.t_start_s}, {"t_end_s", p.t_end_s}});
  return out;
}

json of_run(const std::string& folder) {
  require_undamaged(folder);
  const auto run = analysis::run::read_signals(std::filesystem::path(folder) / "record.h5");
  json passes = json::array();
  for (const signals::PassPhases& p : signals::find_pass_phases(run.pass, run.drive)) {
    json row = {{"pass", p.pass.pass},
                {"t_start_s", p.pass.t_start_s},
                {"t_dig_s", p.pass.t_dig_s},
                {"t_dump_s", p.pass.t_dump_s},
                {"t_end_s", p.pass.t_end_s},
                {"dumped", p.pass.dumped},
                {"payload_kg", p.pass.payload_kg},
                {"truck_kg", p.pass.truck_kg}};
    row["phases"] = list(p.phases);
    passes.push_back(row);
  }
  return {{"passes", passes}};
}

json planned_passes(const std::vector<double>& time_s, const std::vector<double>& door_rad) {
  json passes = json::array();
  for (const signals::PlannedPass& p : signals::find_planned_passes(time_s, door_rad))
    passes.push_back({{"t_start_s", p.t_start_s}, {"t_end_s", p.t_end_s}});
  return {{"passes", passes}};
}

json of_readings(std::istream& in) {
  const json readings = read_json(in);
  signals::DriveSignals drive;
  drive.time_s = readings.at("time_s").get<std::vector<double>>();
  if (readings.contains("door_rad")) return planned_passes(drive.time_s, readings["door_rad"]);
  drive.crowd_m = readings.at("crowd_m").get<std::vector<double>>();
  drive.swing_rad = readings.at("swing_rad").get<std::vector<double>>();
  json passes = json::array();
  std::vector<signals::TimeSpan> spans;
  for (const json& pass : readings.at("passes")) {
    json row = {{"t_start_s", pass.at("t_start_s")}, {"t_end_s", pass.at("t_end_s")}};
    row["phases"] = list(signals::find_phases(drive, row["t_start_s"], row["t_end_s"]));
    spans.push_back({row["t_start_s"], row["t_end_s"]});
    passes.push_back(row);
  }
  json answer = {{"passes", passes}};
  if (readings.contains("hoist_m")) {  // what a law's force may depend on, at each reading
    drive.hoist_m = readings["hoist_m"].get<std::vector<double>>();
    answer["terms"] = signals::kDriveTerms;
    answer["values"] = signals::drive_terms(drive, spans);
  }
  return answer;
}

}  // namespace

int phases_command(const std::string& folder, std::istream& in, Reporter& reporter) {
  try {
    reporter.line((folder == "-" ? of_readings(in) : of_run(folder)).dump());
    return 0;
  } catch (const InputError& e) {
    reporter.error(e.what());
  } catch (const json::exception& e) {
    reporter.error(std::string("standard input: ") + e.what());
  } catch (const std::invalid_argument& e) {
    reporter.error((folder == "-" ? "standard input" : folder) + ": " + e.what());
  }
  return 2;
}

Command add_phases_command(CLI::App& app, Reporter& reporter) {
  const auto folder = std::make_shared<std::string>();
  auto* sub = app.add_subcommand("phases", "passes and phases of a run, as JSON for programs");
  sub->footer(
      "For programs in any language (docs/metrics.md). Example:\n  "
      "dipper phases runs/quick");
  sub->add_option("DIR", *folder, "a run's folder, or - for readings on standard input")
      ->required();
  return {sub, [folder, &reporter] { return phases_command(*folder, std::cin, reporter); }};
}

}  // namespace dipper::cli
