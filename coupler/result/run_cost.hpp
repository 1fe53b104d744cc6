// The cost of a run.
#pragma once

#include <cstdint>

namespace dipper::result {

/// So far, over all segments of a resumed run.
struct RunCost {
  double dem_cpu_s = 0, mbs_cpu_s = 0;
  double wall_s = 0;       ///< wall time of the stepping
  double rock_busy_s = 0;  ///< the part of it in which the rock side steps
  std::int64_t resends = 0, foreign_messages = 0;
};

inline RunCost operator+(const RunCost& a, const RunCost& b) {
  return {a.dem_cpu_s + b.dem_cpu_s, a.mbs_cpu_s + b.mbs_cpu_s,
          a.wall_s + b.wall_s,       a.rock_busy_s + b.rock_busy_s,
          a.resends + b.resends,     a.foreign_messages + b.foreign_messages};
}

}  // namespace dipper::result
