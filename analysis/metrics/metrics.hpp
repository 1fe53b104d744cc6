// Everything `dipper report` computes: docs/metrics.md has the definitions and the schema.
#pragma once

#include <nlohmann/json.hpp>

#include "analysis/rock/wall_fields.hpp"
#include "analysis/run/run_folder.hpp"

namespace dipper::analysis::metrics {

struct Metrics {
  nlohmann::ordered_json values;       ///< metrics.json
  std::vector<rock::WallField> walls;  ///< the maps, too long for it
};

/// Reads the dumps once for the sums and again for single frames. For a mesh without a YAML
/// file, sets the region of the load in `run.regions`. Throws InputError.
Metrics compute_metrics(run::RunData& run, const io::DumpFolder& dumps);

}  // namespace dipper::analysis::metrics
