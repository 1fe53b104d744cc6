// Passes of the shovel, found in the signals of a run: their loads and forces.
#pragma once

#include <vector>

namespace dipper::analysis::signals {

/// A run's signals, one value for each sync step, all of the same length.
struct PassSignals {
  std::vector<double> time_s;
  std::vector<double> door_rad;        ///< 0: closed
  std::vector<double> dipper_force_N;  ///< magnitude of the rock's force on the dipper
  std::vector<double> hoist_force_N;   ///< of the drive
  std::vector<double> crowd_force_N;   ///< of the drive
  std::vector<double> rope_tension_N;  ///< of both hoist ropes
  std::vector<double> dipper_mass_kg;  ///< rock inside the dipper
  std::vector<double> truck_mass_kg;   ///< rock in the truck's bed
};

constexpr double kPayloadWindow_s = 1;  ///< before the door opens, in which the load is weighed

struct Pass {
  int pass = 0;                 ///< from 1
  double t_start_s = 0;         ///< the previous pass's end, or the run's start with the door shut
  double t_dig_s = 0;           ///< the dipper first meets rock
  double t_dump_s = 0;          ///< the door starts to open, above the truck
  double t_end_s = 0;           ///< the door has closed again, or the run ended
  bool dumped = false;          ///< the door has opened and the load has left before the run's end
  double payload_kg = 0;        ///< in the dipper, mean over kPayloadWindow_s before the door opens
  double truck_kg = 0;          ///< gained by the truck during the pass
  double dig_force_mean_N = 0;  ///< sqrt(crowd² + hoist²), t_dig to t_dump (paper, Eq. 11)
  double dig_force_peak_N = 0;
  double dig_force_peak_t_s = 0;  ///< its time
};

/// One pass for every opening of the door, so none for one that is open from the start; in a run
/// that ends before a dump, the last pass is not dumped, with t_dump_s = t_end_s; nor is it in a
/// run that ends with the door open less than 1 s, or while more than a twentieth of the load
/// leaves the dipper, or arrives in the truck, within half a second. The return after the last dump
/// is not a pass, even if the dipper touches rock: it has no load, and the door does not open
/// again. Throws std::invalid_argument when lengths differ.
std::vector<Pass> find_passes(const PassSignals& s);

struct PlannedPass {
  double t_start_s = 0;  ///< the previous pass's end, or the motion's start with the door shut
  double t_end_s = 0;    ///< the door has closed again, or the motion ends
};

/// Every pass of a motion that ends with a dump, from the door's angle alone. Throws
/// std::invalid_argument when lengths differ.
std::vector<PlannedPass> find_planned_passes(const std::vector<double>& time_s,
                                             const std::vector<double>& door_rad);

}  // namespace dipper::analysis::signals
