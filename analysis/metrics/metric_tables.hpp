// The tables of metrics.json, each from its measurements.
#pragma once

#include "analysis/metrics/frame_survey.hpp"
#include "analysis/metrics/metrics.hpp"
#include "analysis/metrics/pass_figures.hpp"
#include "analysis/metrics/pass_signals.hpp"
#include "analysis/metrics/pile_surface.hpp"
#include "analysis/metrics/suspended_load.hpp"

namespace dipper::analysis::metrics {

using json = nlohmann::ordered_json;

/// One pass, from signals and dumps.
struct PassFacts : PassFigures {
  LoadToFollow followed;
  std::optional<LoadFate> fate;  ///< none: no frame of the dig, or none after the dump
  std::vector<rock::Stage> stages;
  std::optional<StaticWeight> still;
  std::optional<SuspendedLoad> suspended;
};

json run_table(const run::RunData& run, const io::DumpFolder& dumps, const Survey& survey);
json passes_table(const std::vector<PassFacts>& passes);
json stages_table(const io::DumpFolder& dumps, const Survey& survey,
                  const std::vector<PassFacts>& passes);
json frames_table(const io::DumpFolder& dumps, const Survey& survey,
                  const rock::LoadRegions& regions);
/// `after` is null where there is one frame.
json pile_table(const PileSurface& before, const PileSurface* after);
json sizes_table(const run::RunData& run, const Survey& survey,
                 const std::vector<PassFacts>& passes);
json walls_table(const std::vector<rock::WallField>& fields);

}  // namespace dipper::analysis::metrics
