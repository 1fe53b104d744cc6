// The load in the dipper as a machine's own scale has it: from the pull of its hoist.
#pragma once

#include "machine/kinematics.hpp"
#include "machine/machine_data.hpp"
#include "machine/motion.hpp"

namespace dipper::machine {

/// Moments about the saddle, in balance while the dipper hangs still: the pull of the ropes lifts,
/// handle, dipper, door and load press down. The load's centre is taken in the middle of the
/// dipper's inside, and the masses are those of the machine's file: what rides on the dipper
/// (liners, rock that sticks) is weighed as load. Forces of the face, and of acceleration, are too.
class PayloadEstimate {
 public:
  /// \param rake  handle centre line to dipper floor, rad
  PayloadEstimate(const MachineData& machine, double rake);

  /// kg, below 0 too. \param hoist_force  N, of both ropes together
  /// Throws std::domain_error where the ropes have no path (ShovelKinematics::saddle_angle).
  double load_kg(const Drives& at, double hoist_force) const;

 private:
  MachineData machine_;
  ShovelKinematics shovel_;
};

}  // namespace dipper::machine
