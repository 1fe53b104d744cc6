#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "analysis/signals/passes.hpp"

namespace dipper::run {

/// What summary.json says beyond what is in record.h5.
struct RunFacts {
  std::string case_name;
  std::int64_t seed = 0;
  std::string status;  ///< "complete", "interrupted" or "failed"
  std::string scheme;
  std::map<std::string, double> effects;  ///< of the case, with their strengths
  std::int64_t syncs = 0, resends = 0, foreign_messages = 0;
  double interface_work_J = 0, energy_residual_J = 0;
  double rock_wait_s = 0;  ///< wall time spent waiting for the rock side
  double wall_s = 0;       ///< wall time of the stepping loop
  double timestep_s = 0;
  std::int64_t dem_steps = 0;
  std::int64_t particles = 0, bodies = 0;
  double dem_cpu_s = 0, mbs_cpu_s = 0;
  double struck_volume_m3 = 0, bulk_density_kg_m3 = 0;
  std::string state_hash;
  std::string failure;  ///< with "failed": side, time, message
};

/// The signals that tell the passes, from a record.
analysis::signals::PassSignals read_pass_signals(const std::filesystem::path& record);

/// The keys of design.md, "Files". Passes are found in the record.
nlohmann::ordered_json summarise(const RunFacts& facts, const std::filesystem::path& record);

}  // namespace dipper::run
