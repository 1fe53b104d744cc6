// A run as the mine's instruments would record it: the drives' logger and the truck's scale.
#pragma once

#include <vector>

#include "analysis/signals/drive_signals.hpp"
#include "analysis/signals/drive_terms.hpp"
#include "analysis/signals/passes.hpp"

namespace dipper::analysis::signals {

/// The settings of the instruments (case keys observation.*).
struct Instruments {
  double rate_Hz = 1;
  double lag_s = 0;  ///< the force logged at t is that at t - lag
  double scale_gain = 0;
  double truck_spillage = 0;
  double scale_offset_t = 0;
  double hoist_cell_gain = 0, crowd_cell_gain = 0;
  double door_leak = 0;  ///< fraction of each load that is lost before the truck (door_leak.hpp)
  ForceLaw hoist_law, crowd_law;  ///< added to the forces
};

/// One line of signals.csv. Each value is the mean over 1/rate before time_s, as of a logger that
/// filters before it samples.
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

/// Samples at 1/rate, 2/rate, ... to the end of the signals. Forces before the first or after the
/// last sync step are those at the ends; a cell reads 1 + its gain times the force, plus its law's
/// force at the logged motion. `passes` are needed by the laws. Throws std::invalid_argument for
/// signals of different lengths.
std::vector<LoggedSample> log_signals(const DriveSignals& signals, const Instruments& instruments,
                                      const std::vector<TimeSpan>& passes = {});

/// The scale reads (1 + scale_gain) times the mass of each pass that has dumped, plus
/// scale_offset_t for each pass with rock, never below 0; door_leak is lost from every pass,
/// truck_spillage from the last one.
std::vector<WeighedPass> weigh(const std::vector<Pass>& passes, const Instruments& instruments);

}  // namespace dipper::analysis::signals
