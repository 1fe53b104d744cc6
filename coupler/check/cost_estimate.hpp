// What a run of a case will take, before it is started.
#pragma once

#include <filesystem>
#include <string>

#include "common/reporter.hpp"
#include "coupler/case/case.hpp"

namespace dipper::check {

struct CostEstimate {
  double spheres = 0;   ///< of the settled pile
  double settle_s = 0;  ///< processor time, once for each pile
  double dig_s = 0;     ///< processor time
  double wall_s = 0;    ///< of both, on as many cores as ranks
  double memory_B = 0;
  double disk_B = 0;    ///< of the run's folder
  double record_B = 0;  ///< of that, record.h5
  double dumps_B = 0;  ///< of that, what output.dump_every_s asks for beside the dumps of the start
};

/// From measured runs (docs/benchmarks.md, "What a run takes"): accurate within a factor of 2 on
/// such a machine, because it is not known beforehand how much of the rock will move.
CostEstimate cost_estimate(const cases::Case& c);

/// In a line: "about 1 h 40 min of processor time, ...".
std::string to_string(const CostEstimate& cost);

/// Warns when a run in `folder`, which need not exist yet, would fill the disk.
void report_full_disk(const cases::Case& c, const std::filesystem::path& folder,
                      Reporter& reporter);

}  // namespace dipper::check
