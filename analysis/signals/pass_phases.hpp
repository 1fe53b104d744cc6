// The passes of a run with the phases of each.
#pragma once

#include <optional>
#include <vector>

#include "analysis/signals/passes.hpp"
#include "analysis/signals/phases.hpp"

namespace dipper::analysis::signals {

struct PassPhases {
  Pass pass;
  double t_end_s = 0;         ///< of its last phase: the return belongs to the last pass
  std::vector<Phase> phases;  ///< without gaps from pass.t_start_s to t_end_s
  /// sqrt(crowd² + hoist²) from the start of penetrate to the end of breakout, time-weighted. The
  /// pass's own mean (paper, Eq. 11) includes the swing. None without such phases.
  std::optional<double> dig_phases_force_mean_N;
  /// The fraction of that time in which the hoist ropes are slack: the dipper rides on rock.
  std::optional<double> dig_slack_fraction;

  /// Null when the pass does not have the phase.
  const Phase* phase(PhaseName name) const;

  /// From the start of penetrate to the end of breakout; none without such phases.
  std::optional<TimeSpan> dig() const;
};

/// Ropes that pull less than this are slack; under the empty dipper they pull a hundred times as
/// much. The drive's own force does not show it: a motor accelerates its drum, too.
inline constexpr double kSlack_N = 10e3;

/// The fraction of a time in which the hoist ropes are slack; 0 without a reading in it.
double slack_fraction(const PassSignals& s, double t_start_s, double t_end_s);

/// Both signals are of one run, one value for each sync step. Throws std::invalid_argument when
/// lengths differ.
std::vector<PassPhases> find_pass_phases(const PassSignals& s, const DriveSignals& drive);

}  // namespace dipper::analysis::signals
