// Figures of a phase and of a load from the record's signals.
#pragma once

#include <optional>

#include "analysis/run/run_folder.hpp"
#include "analysis/signals/drive_work.hpp"

namespace dipper::analysis::metrics {

/// Forces and work in a part of a run.
struct Effort {
  double dig_force_mean_N = 0;  ///< sqrt(crowd² + hoist²), time-weighted (paper, Eq. 11)
  double dig_force_peak_N = 0;
  signals::DrivesWork drives;
  double rock_work_J = 0;   ///< by the rock on the walls: negative while digging
  double mass_gain_kg = 0;  ///< of the dipper
};

/// Between two times, by the trapezoidal rule over the rows there (signals::rows_within): an
/// interval that lies between two rows has their forces, and its part of their work and mass.
Effort effort(const run::RunSignals& s, double t_start_s, double t_end_s);

/// The load from the rock's weight on dipper and door while they hang level: the end of the swing
/// changes the force's horizontal part only.
struct StaticWeight {
  double mass_kg = 0;
  double from_s = 0, to_s = 0;
};

/// The mean over the last second before the door opens, of the rows in which the dipper's origin
/// rises or sinks slower than 0.05 m/s and the door is latched; empty when those are fewer than
/// half of it.
std::optional<StaticWeight> static_weight(const run::RunSignals& s, const signals::Pass& pass);

}  // namespace dipper::analysis::metrics
