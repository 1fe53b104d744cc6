// What a run of a case will take, before it is started.
#pragma once

#include <string>

#include "coupler/case/case.hpp"

namespace dipper::check {

struct CostEstimate {
  double spheres = 0;   ///< of the settled pile
  double settle_s = 0;  ///< processor time, once for each pile
  double dig_s = 0;     ///< processor time
  double wall_s = 0;    ///< of both, on as many cores as ranks
  double memory_B = 0;
  double disk_B = 0;  ///< of the run's folder
};

/// By what runs have taken (docs/benchmarks.md, "What a run takes"): right to a factor of about 1.5
/// on such a machine, as it is not known beforehand how much of the rock will move.
CostEstimate cost_estimate(const cases::Case& c);

/// In a line: "about 1 h 40 min of processor time, ...".
std::string to_string(const CostEstimate& cost);

}  // namespace dipper::check
