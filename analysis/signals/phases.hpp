// The phases of a pass, from the driven signals: what a logger has, at its rate.
#pragma once

#include <string>
#include <vector>

#include "analysis/signals/drive_signals.hpp"

namespace dipper::analysis::signals {

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

/// The phases of the pass between two times, from crowd and swing, in order and without gaps; those
/// that take no time are left out. Any rate: half a second apart or a millisecond gives the same
/// phases, but for the curvature between readings. Throws std::invalid_argument for signals of
/// different lengths or without two readings in the pass.
std::vector<Phase> find_phases(const DriveSignals& s, double t_start_s, double t_end_s,
                               const PhaseRules& rules = {});

}  // namespace dipper::analysis::signals
