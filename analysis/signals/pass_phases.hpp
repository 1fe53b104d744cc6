// The passes of a run with the phases of each: the one place that puts the two together.
#pragma once

#include <optional>
#include <vector>

#include "analysis/signals/passes.hpp"
#include "analysis/signals/phases.hpp"

namespace dipper::analysis::signals {

struct PassPhases {
  Pass pass;
  double t_end_s = 0;         ///< of its last phase: the way home belongs to the last pass
  std::vector<Phase> phases;  ///< without gaps from pass.t_start_s to t_end_s
  /// sqrt(crowd² + hoist²) from the start of penetrate to the end of breakout, time-weighted. The
  /// pass's own mean (paper, Eq. 11) goes on over the swing. None: there is no such phase.
  std::optional<double> dig_phases_force_mean_N;
  /// The part of that time in which the hoist ropes are slack: the dipper rides on rock.
  std::optional<double> dig_slack_fraction;

  /// Null when the pass has no such phase.
  const Phase* phase(PhaseName name) const;

  /// From the start of penetrate to the end of breakout; no such phase: none.
  std::optional<TimeSpan> dig() const;
};

/// Ropes that pull less than this are slack; the empty dipper on them pulls a hundred times as
/// much.
inline constexpr double kSlack_N = 10e3;

/// The part of a time in which the hoist ropes are slack; 0 when there is no reading in it.
double slack_fraction(const PassSignals& s, double t_start_s, double t_end_s);

/// Both signals are of one run, a value a sync step. Throws std::invalid_argument when lengths
/// differ.
std::vector<PassPhases> find_pass_phases(const PassSignals& s, const DriveSignals& drive);

}  // namespace dipper::analysis::signals
