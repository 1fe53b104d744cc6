// The payload as a shovel's own monitor finds it: from the drives alone, during the swing.
#pragma once

#include <optional>
#include <vector>

#include "analysis/signals/drive_signals.hpp"
#include "analysis/signals/pass_phases.hpp"
#include "machine/handle_statics.hpp"
#include "machine/machine_data.hpp"

namespace dipper::analysis::signals {

/// The monitor's result for a pass.
struct MonitorReading {
  double mass_kg = 0;
  double from_s = 0, to_s = 0;  ///< first and last reading of the mean
  bool at_rest = true;          ///< hoist and crowd stand still in all of them
  std::vector<std::size_t> rows;
};

/// Balances moments about the saddle block and forces along the handle, in the frame of the house,
/// of handle, dipper and door, whose masses are known, and a load in the middle of the dipper: the
/// load is what hoist and crowd carry beyond the empty machine. Poses follow from hoist and crowd
/// with rigid ropes; the swing's centrifugal force is subtracted, accelerations are neglected.
class PayloadMonitor {
 public:
  /// \param machine with the maker's masses
  /// \param rake handle's centre line to dipper's floor, rad
  PayloadMonitor(const machine::MachineData& machine, double rake)
      : machine_(machine), rake_(rake) {}

  /// The mean over the readings between the start of the swing and the opening of the door in which
  /// hoist and crowd stand still; over all readings if they never do for half a second. The mass is
  /// the least-squares solution of both balances, with their errors in N: with the handle level the
  /// crowd carries none of the load and has no weight in it. None: the pass has not dumped, or does
  /// not swing.
  std::optional<MonitorReading> weigh(const DriveSignals& s, const std::vector<double>& door_rad,
                                      const PassPhases& pass) const;

  /// The forces in hoist and crowd of one kilogram in the middle of the dipper, at rest. None where
  /// the ropes are slack.
  std::optional<machine::Holding> holding_of_a_kg(double hoist_m, double crowd_m) const;

 private:
  machine::MachineData machine_;
  double rake_;
};

}  // namespace dipper::analysis::signals
