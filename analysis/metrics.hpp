// Everything `dipper report` computes: docs/metrics.md has the definitions and the schema.
#pragma once

#include <nlohmann/json.hpp>

#include "analysis/run_folder.hpp"
#include "analysis/wall_fields.hpp"

namespace dipper {

struct Metrics {
  nlohmann::ordered_json values;  ///< metrics.json
  std::vector<WallField> walls;   ///< the maps, too long for it
};

/// Reads the dumps once for the sums and again for single frames. For a mesh without a file beside
/// it, the region of the load is set in `run.places`. Throws InputError.
Metrics compute_metrics(RunFolder& run, const DumpFolder& dumps);

}  // namespace dipper
