#include "coupler/check/warnings.hpp"

#include <algorithm>

#include "common/angles.hpp"
#include "common/mesh/stl.hpp"
#include "coupler/check/check_parts.hpp"
#include "coupler/check/warning_parts.hpp"

namespace dipper::check {
CaseParts::CaseParts(const cases::Case& the_case)
    : c(the_case),
      machine(machine::load_machine(c.machine.model)),
      dug(dug_motion(c)),
      motion(dug.motion),
      shovel(machine, Pose{Quaterniond::Identity(), c.machine.base_position_m},
             radians(c.machine.rake_angle_deg)),
      dipper(mesh::read_stl(c.bodies.at("dipper"))),
      truck(placed_truck(c, mesh::read_stl(c.truck.mesh))) {
  if (const auto found = c.bodies.find("door"); found != c.bodies.end())
    door = mesh::read_stl(found->second);
}

std::vector<Finding> warnings(const cases::Case& c) {
  if (c.machine.kind == cases::MachineKind::shovel) return warnings(CaseParts(c));
  std::vector<Finding> found;
  warn_of_sieve(c, found);
  warn_of_bench(c, found);
  warn_of_poses(c, found);
  warn_of_pose_bodies(c, found);
  return found;
}

std::vector<Finding> warnings(const CaseParts& parts) {
  std::vector<Finding> found;
  warn_of_sieve(parts.c, found);
  warn_of_bench(parts.c, found);
  warn_of_numbers(parts, found);
  warn_of_machine(parts, found);
  const auto of_the_mesh = [](const Finding& warning) { return warning.key == "bodies.dipper"; };
  if (std::none_of(found.begin(), found.end(), of_the_mesh)) warn_of_volume(parts, found);
  warn_of_sweep(parts, found);
  warn_of_places(parts, found);
  return found;
}

}  // namespace dipper::check
