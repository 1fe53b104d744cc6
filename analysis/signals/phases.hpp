// The phases of a pass, from the driven signals, at any logger's rate.
#pragma once

#include <array>
#include <vector>

#include "analysis/signals/drive_signals.hpp"

namespace dipper::analysis::signals {

/// In the order of a pass.
enum class PhaseName { approach, penetrate, fill, breakout, swing, dump, back };

/// The phases' names in files and pages, in that order; defined only here.
inline constexpr std::array<const char*, 7> kPhaseWords = {
    "approach", "penetrate", "fill", "breakout", "swing", "dump", "return"};

inline const char* word(PhaseName name) { return kPhaseWords.at(static_cast<std::size_t>(name)); }

/// A part of a run.
struct TimeSpan {
  double t_start_s = 0, t_end_s = 0;
};

struct Phase : TimeSpan {
  Phase(PhaseName phase_name, double from_s, double to_s)
      : TimeSpan{from_s, to_s}, name(phase_name) {}
  PhaseName name;
};

/// Limits between phases: fractions of the crowd's stroke before the swing, and of the largest
/// swing (docs/metrics.md has the table).
struct PhaseRules {
  double penetrate_from = 0.10, fill_from = 0.45, breakout_from = 0.97;
  double swing_from = 0.05, dump_from = 0.97;
  double least_swing_rad = 0.1;  ///< a pass that turns by less has no swing
};

/// The phases of the pass between two times, from crowd and swing, in order and without gaps;
/// phases of no duration are left out. Readings half a second apart or a millisecond apart give the
/// same phases, except for the curvature between readings. Throws std::invalid_argument for signals
/// of different lengths or without two readings in the pass.
std::vector<Phase> find_phases(const DriveSignals& s, double t_start_s, double t_end_s,
                               const PhaseRules& rules = {});

/// The house's angle during that pass's dig: where the crowd, on its longest way out at one
/// heading, is nearly all out. Throws std::invalid_argument as find_phases does.
double dig_heading_rad(const DriveSignals& s, double t_start_s, double t_end_s,
                       const PhaseRules& rules = {});

}  // namespace dipper::analysis::signals
