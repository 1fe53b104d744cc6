// Differences of a machine in the mine from its data sheet.
#pragma once

#include "machine/machine_data.hpp"

namespace dipper::machine {

/// The defaults are a machine as its file says.
struct MachineCondition {
  double crowd_friction_N = 0;
  double hoist_loss = 0;       ///< of the rope's tension, in the sheaves
  double rope_compliance = 1;  ///< stretch at a load, as a multiple of the file's

  /// Masses on the dipper: liners, rock that sticks. In B; the inertia about its own mass
  /// centre, axes of B.
  double added_mass_kg = 0;
  Vector3d added_center_m = Vector3d::Zero();
  Vector3d added_inertia_kg_m2 = Vector3d::Zero();
};

/// Products of inertia of a layer off the dipper's middle plane z = 0 are neglected, as for the
/// dipper itself.
MachineData in_condition(MachineData machine, const MachineCondition& condition);

}  // namespace dipper::machine
