#include "analysis/report/run_page.hpp"

#include "analysis/report/dump_replay.hpp"
#include "analysis/report/record_curves.hpp"
#include "analysis/report/report_page.hpp"
#include "common/json_values.hpp"

namespace dipper::analysis::report {

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
  input.figure = figure;
  if (run.is_run) read_curves(run, input);
  std::string title = run.text("title");
  if (title.empty()) title = std::filesystem::weakly_canonical(run.folder).filename().string();
  write_report_page(title, input, file);
}

}  // namespace dipper::analysis::report
