// The work of the drives in a part of a run.
#pragma once

#include <optional>

#include "analysis/signals/drive_signals.hpp"
#include "analysis/signals/pass_phases.hpp"

namespace dipper::analysis::signals {

/// Of one drive; negative where it brakes.
struct DriveWork {
  double work_J = 0;
  double power_mean_W = 0;
  double power_peak_W = 0;  ///< largest power into the machine
};

struct DrivesWork {
  DriveWork hoist, crowd, swing;
};

/// Between two times, by the trapezoidal rule over the readings there (rows_within): an interval
/// that lies between two readings has their powers, and its part of their work. Throws
/// std::invalid_argument when powers and times differ in number.
DrivesWork drives_work(const DriveSignals& s, double t_start_s, double t_end_s);

/// The work of a pass's dig: hoist and crowd from the start of penetrate to the end of breakout.
struct DigEnergy {
  double work_J = 0;
  std::optional<double> specific_J_kg;  ///< divided by the payload; none without a payload
};

/// None: the pass does not have these phases.
std::optional<DigEnergy> dig_energy(const DriveSignals& s, const PassPhases& pass);

}  // namespace dipper::analysis::signals
