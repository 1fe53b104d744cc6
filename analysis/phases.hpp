// The phases of a pass, from the driven signals: what a logger has, at its rate.
#pragma once

#include <string>
#include <vector>

namespace dipper {

/// Drive positions against time, of the same length, times rising. Any rate: half a second apart or
/// a millisecond gives the same phases, but for the curvature between readings.
struct DriveSignals {
  std::vector<double> time_s;
  std::vector<double> crowd_m;    ///< out: larger
  std::vector<double> swing_rad;  ///< either way
};

struct Phase {
  std::string name;  ///< approach, penetrate, fill, breakout, swing, dump or return
  double t_start_s = 0, t_end_s = 0;
};

/// Where one phase becomes the next: shares of the crowd's stroke before the swing, and of the
/// largest swing (docs/metrics.md has the table).
struct PhaseRules {
  double penetrate_from = 0.10, fill_from = 0.45, breakout_from = 0.97;
  double swing_from = 0.05, dump_from = 0.97;
  double least_swing_rad = 0.1;  ///< a pass that turns by less does not swing
};

/// The phases of the pass between two times, in order and without gaps; those that take no time are
/// left out. Throws std::invalid_argument for signals of different lengths or without two readings
/// in the pass.
std::vector<Phase> find_phases(const DriveSignals& s, double t_start_s, double t_end_s,
                               const PhaseRules& rules = {});

}  // namespace dipper
