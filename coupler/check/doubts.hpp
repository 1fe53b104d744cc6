// What is legal in a case and yet makes no sense: a user has to see it, and may know better.
#pragma once

#include <vector>

#include "common/mesh/triangle_mesh.hpp"
#include "coupler/case/case.hpp"
#include "machine/kinematics.hpp"
#include "machine/machine_data.hpp"
#include "machine/motion.hpp"

namespace dipper::check {

/// Every doubt about a case that check_case found nothing wrong with.
std::vector<Finding> doubts(const cases::Case& c);

/// What the parts of doubts() look at, read from the case's files.
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
/// truck, the truck against the dump.
void doubt_places(const CaseParts& parts, std::vector<Finding>& doubts);

/// Numbers that look as if in another unit, or of no such machine, mesh or pile.
void doubt_numbers(const CaseParts& parts, std::vector<Finding>& doubts);

}  // namespace dipper::check
