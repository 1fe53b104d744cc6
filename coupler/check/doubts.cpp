#include "coupler/check/doubts.hpp"

#include "common/angles.hpp"
#include "common/mesh/stl.hpp"

namespace dipper::check {
namespace {

mesh::TriangleMesh placed_truck(const cases::Case& c) {
  mesh::TriangleMesh truck = mesh::read_stl(c.truck.mesh);
  const Eigen::AngleAxisd turn(radians(c.truck.heading_deg), Vector3d::UnitZ());
  for (Vector3d& v : truck.vertices) v = c.truck.position_m + turn * v;
  return truck;
}

}  // namespace

CaseParts::CaseParts(const cases::Case& the_case)
    : c(the_case),
      machine(machine::load_machine(c.machine.model)),
      motion(machine::Motion::load(c.machine.motion)),
      shovel(machine, Pose{Quaterniond::Identity(), c.machine.base_position_m},
             radians(c.machine.rake_angle_deg)),
      dipper(mesh::read_stl(c.bodies.at("dipper"))),
      truck(placed_truck(c)) {
  if (const auto found = c.bodies.find("door"); found != c.bodies.end())
    door = mesh::read_stl(found->second);
}

std::vector<Finding> doubts(const cases::Case& c) {
  std::vector<Finding> found;
  const CaseParts parts(c);
  doubt_numbers(parts, found);
  doubt_places(parts, found);
  return found;
}

}  // namespace dipper::check
