// The parts of warnings(), and what they look at. Internal to it.
#pragma once

#include <vector>

#include "common/mesh/triangle_mesh.hpp"
#include "coupler/case/case.hpp"
#include "machine/kinematics.hpp"
#include "machine/machine_data.hpp"
#include "machine/motion.hpp"

namespace dipper::check {

/// A sound case with what its files hold.
struct CaseParts {
  explicit CaseParts(const cases::Case& c);

  const cases::Case& c;
  machine::MachineData machine;
  machine::Motion motion;
  machine::ShovelKinematics shovel;
  mesh::TriangleMesh dipper, door;  ///< the door is empty when the case has none
  mesh::TriangleMesh truck;         ///< in W
};

/// Where things are: machine and truck against the bench at the start, the dipper's way against the
/// truck, the truck against the dump, the way back against the next dig, the heel against the
/// teeth's way.
void warn_of_places(const CaseParts& parts, std::vector<Finding>& warnings);

/// What the mesh holds against what its YAML and the machine say; of a mesh that has no other
/// fault.
void warn_of_volume(const CaseParts& parts, std::vector<Finding>& warnings);

/// Numbers that look as if in another unit, or of no such machine, mesh or pile.
void warn_of_numbers(const CaseParts& parts, std::vector<Finding>& warnings);

}  // namespace dipper::check
