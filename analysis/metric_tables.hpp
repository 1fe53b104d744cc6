// The tables of metrics.json, each from what was measured for it.
#pragma once

#include "analysis/frame_survey.hpp"
#include "analysis/hung_load.hpp"
#include "analysis/metrics.hpp"
#include "analysis/pass_signals.hpp"
#include "analysis/pile_surface.hpp"
#include "analysis/struck_volume.hpp"

namespace dipper {

using json = nlohmann::ordered_json;

/// One pass as the signals and the dumps have it.
struct PassFacts {
  Pass pass;
  std::vector<Phase> phases;
  LoadToFollow load;
  LoadFate fate;
  double load_volume_m3 = 0;  ///< 0: not known
  double load_in_volume_kg = 0;
  std::vector<Stage> stages;
  std::optional<StillWeight> still;
  std::optional<HungLoad> hung;

  const Phase* phase(const std::string& name) const;
};

json run_table(const RunFolder& run, const DumpFolder& dumps, const Survey& survey);
json passes_table(const RunFolder& run, const std::vector<PassFacts>& passes, double struck_m3);
json phases_table(const RunFolder& run, const std::vector<PassFacts>& passes);
json stages_table(const DumpFolder& dumps, const Survey& survey,
                  const std::vector<PassFacts>& passes);
json frames_table(const DumpFolder& dumps, const Survey& survey, const Places& places);
json pile_table(const PileSurface& before, const PileSurface& after);
json sizes_table(const RunFolder& run, const Survey& survey, const std::vector<PassFacts>& passes);
json walls_table(const std::vector<WallField>& fields);

}  // namespace dipper
