// The payload as a shovel's own monitor finds it: from the drives alone, while it swings.
#pragma once

#include <optional>
#include <vector>

#include "analysis/signals/drive_signals.hpp"
#include "analysis/signals/pass_phases.hpp"
#include "machine/handle_statics.hpp"
#include "machine/machine_data.hpp"

namespace dipper::analysis::signals {

/// What the monitor shows of a pass.
struct MonitorReading {
  double mass_kg = 0;
  double from_s = 0, to_s = 0;  ///< the first and last reading it is the mean of
  bool at_rest = true;          ///< hoist and crowd stand in all of them
  std::vector<std::size_t> rows;
};

/// Handle, dipper and door, whose masses it knows, and a load in the middle of the dipper, in
/// balance about the saddle block and along the handle, in the frame of the house: what hoist and
/// crowd carry beyond the empty machine is the load. Poses follow from hoist and crowd with ropes
/// that do not stretch; the swing's centrifugal force is taken off, accelerations are not.
class PayloadMonitor {
 public:
  /// \param machine as its maker has weighed it
  /// \param rake handle's centre line to dipper's floor, rad
  PayloadMonitor(const machine::MachineData& machine, double rake)
      : machine_(machine), rake_(rake) {}

  /// The mean over the readings, from the start of the swing until the door gives way, in which
  /// hoist and crowd stand; over all of them where they never do for half a second. With both
  /// balances' errors in N, m is that of least squares: with the handle level the crowd tells
  /// nothing of the load, and counts for nothing. None: the pass has not dumped, or does not swing.
  std::optional<MonitorReading> weigh(const DriveSignals& s, const std::vector<double>& door_rad,
                                      const PassPhases& pass) const;

  /// What a kilogram in the middle of the dipper adds to hoist and crowd, at rest. None where the
  /// ropes hang slack.
  std::optional<machine::Holding> holding_of_a_kg(double hoist_m, double crowd_m) const;

 private:
  machine::MachineData machine_;
  double rake_;
};

}  // namespace dipper::analysis::signals
