#include "analysis/report/run_page.hpp"

#include <string>

#include "analysis/report/dump_replay.hpp"
#include "analysis/report/record_curves.hpp"
#include "analysis/report/report_page.hpp"
#include "common/json_text.hpp"
#include "common/json_values.hpp"

namespace dipper::analysis::report {
namespace {

/// What an operator who plans left in a run's folder, pass by pass; null: nothing.
nlohmann::json decisions(const std::filesystem::path& run) {
  const auto read = [&](const std::string& name) {
    return read_json_or_discard(run / "operator" / name);
  };
  nlohmann::json all = nlohmann::json::array();
  for (int pass = 1;; ++pass) {
    nlohmann::json one = read("pass_" + std::to_string(pass) + ".json");
    if (!one.is_object()) break;
    one.erase("rows");  // of the motion: for those who want it again
    all.push_back(std::move(one));
  }
  if (all.empty()) return nullptr;
  const nlohmann::json end = read("end.json");
  return {{"decisions", all}, {"end", end.is_object() ? end : nlohmann::json()}};
}

}  // namespace

void write_run_page(const run::RunData& run, const io::DumpFolder& dumps,
                    const nlohmann::ordered_json& metrics, const run::Figure& figure,
                    const std::filesystem::path& file) {
  const DumpReplay replay(dumps, replay_walls(run));
  ReportInput input;
  input.metrics = metrics;
  if (run.regions.dipper) {  // the cavity with its heap, for the zones in the slices
    const auto& region = *run.regions.dipper;
    input.metrics["dipper"]["load_region"] = {{"min_m", json_of(region.min_m)},
                                              {"max_m", json_of(region.max_m)}};
  }
  input.case_text = run.case_text;
  input.replay = &replay;
  input.decisions = decisions(run.folder);
  input.figure = figure;
  if (run.is_run) read_curves(run, input);
  std::string title = run.text("title");
  if (title.empty()) title = std::filesystem::weakly_canonical(run.folder).filename().string();
  write_report_page(title, input, file);
}

}  // namespace dipper::analysis::report
