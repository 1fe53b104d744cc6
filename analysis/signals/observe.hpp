// A run as the mine's instruments would have seen it: the drives' logger and the truck's scale.
#pragma once

#include <vector>

#include "analysis/signals/drive_signals.hpp"
#include "analysis/signals/drive_terms.hpp"
#include "analysis/signals/passes.hpp"

namespace dipper::analysis::signals {

/// How the instruments are set (case keys observation.*).
struct Instruments {
  double rate_Hz = 1;
  double lag_s = 0;  ///< the force logged at t was there at t - lag
  double scale_gain = 0;
  double truck_spillage = 0;
  double scale_offset_t = 0;
  double hoist_cell_gain = 0, crowd_cell_gain = 0;
  double door_leak = 0;  ///< share of each load that the truck does not get (door_leak.hpp)
  ForceLaw hoist_law, crowd_law;  ///< what the forces have besides
};

/// One line of signals.csv. Each value is the mean over the 1/rate up to time_s, as a logger that
/// filters before it samples gives it.
struct LoggedSample {
  double time_s;
  double hoist_m, crowd_m, swing_rad;
  double hoist_force_kN, crowd_force_kN;
};

/// One line of passes.csv.
struct WeighedPass {
  int pass;
  double t_start_s, t_end_s;
  double truck_mass_t;  ///< gained by the truck
};

/// Samples at 1/rate, 2/rate, ... as far as the signals reach. Forces wanted before the first or
/// after the last sync step are those at the ends; a cell reads 1 + its gain times the force, and
/// its law's force at the logged motion more. `passes` are those of the laws. Throws
/// std::invalid_argument for signals of different lengths.
std::vector<LoggedSample> log_signals(const DriveSignals& signals, const Instruments& instruments,
                                      const std::vector<TimeSpan>& passes = {});

/// The scale reads (1 + scale_gain) times what a pass brought, and scale_offset_t more of each pass
/// that brought rock, 0 at least; of every pass door_leak, and of the last truck_spillage is lost.
std::vector<WeighedPass> weigh(const std::vector<Pass>& passes, const Instruments& instruments);

}  // namespace dipper::analysis::signals
