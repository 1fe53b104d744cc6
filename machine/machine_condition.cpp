#include "machine/machine_condition.hpp"

namespace dipper::machine {
namespace {

/// Moments of inertia of a point mass about axes through the origin.
Vector3d point_inertia(double mass, const Vector3d& at) {
  const Vector3d sq = at.cwiseAbs2();
  return mass * (Vector3d::Constant(sq.sum()) - sq);
}

}  // namespace

MachineData in_condition(MachineData machine, const MachineCondition& c) {
  machine.losses = {c.crowd_friction_N, c.hoist_loss};
  machine.rope.axial_stiffness /= c.rope_compliance;
  if (c.added_mass_kg > 0) {
    auto& d = machine.dipper;
    const double mass = d.mass + c.added_mass_kg;
    const Vector3d center = (d.mass * d.mass_center + c.added_mass_kg * c.added_center_m) / mass;
    d.inertia += c.added_inertia_kg_m2 + point_inertia(d.mass, d.mass_center - center) +
                 point_inertia(c.added_mass_kg, c.added_center_m - center);
    d.mass = mass;
    d.mass_center = center;
  }
  return machine;
}

}  // namespace dipper::machine
