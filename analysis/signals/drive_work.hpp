// What the drives put into the machine over a part of a run.
#pragma once

#include <optional>

#include "analysis/signals/drive_signals.hpp"
#include "analysis/signals/pass_phases.hpp"

namespace dipper::analysis::signals {

/// Of one drive; negative where it brakes.
struct DriveWork {
  double work_J = 0;
  double power_mean_W = 0;
  double power_peak_W = 0;  ///< the most that it puts in at once
};

struct DrivesWork {
  DriveWork hoist, crowd, swing;
};

/// Between two times, by the trapezoidal rule over the readings there (rows_within): the powers of
/// a time between two of them are theirs, the work its share of theirs. Throws
/// std::invalid_argument for powers that are not as many as the times.
DrivesWork drives_work(const DriveSignals& s, double t_start_s, double t_end_s);

/// What a pass's dig takes: hoist and crowd from the start of penetrate to the end of breakout.
struct DigEnergy {
  double work_J = 0;
  std::optional<double> specific_J_kg;  ///< by the payload; none: there is no payload
};

/// None: the pass has no such phase.
std::optional<DigEnergy> dig_energy(const DriveSignals& s, const PassPhases& pass);

}  // namespace dipper::analysis::signals
