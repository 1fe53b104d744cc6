#include "machine/handle_statics.hpp"

#include <algorithm>
#include <cmath>

#include "common/gravity.hpp"
#include "machine/sheave_path.hpp"

namespace dipper::machine {
namespace {

Vector2d out_and_up(const Vector3d& p) { return {p.x(), p.z()}; }

}  // namespace

Burden HandlePlace::of(const Vector2d& p, const Vector2d& force) const {
  const Vector2d r = p - saddle_;
  return {r.x() * force.y() - r.y() * force.x(), force.dot(out_)};
}

Burden HandlePlace::of_mass(double kg, const Vector2d& p, double swing_rad_s) const {
  return of(p, kg * Vector2d(swing_rad_s * swing_rad_s * p.x(), -kGravity_m_s2));
}

Burden HandlePlace::empty(double swing_rad_s) const {
  return of_mass(mass_of_handle_, handle_, swing_rad_s) +
         of_mass(mass_of_dipper_, dipper_, swing_rad_s) +
         of_mass(mass_of_door_, door_, swing_rad_s);
}

Holding HandlePlace::holding(const Burden& burden) const {
  const double hoist = std::max(0.0, -burden.moment / arm_);
  return {hoist, -burden.along - hoist * rope_.dot(out_)};
}

Burden HandlePlace::held(const Holding& by) const {
  return {-by.hoist * arm_, -by.crowd - by.hoist * rope_.dot(out_)};
}

DigLoad HandlePlace::dig_load(const Holding& by) const {
  const Burden b = held(by) - empty(), kg = of_a_kg(), newton = of_a_newton();
  const double both = kg.moment * newton.along - newton.moment * kg.along;
  return {(b.moment * newton.along - newton.moment * b.along) / both,
          (kg.moment * b.along - b.moment * kg.along) / both};
}

HandleStatics::HandleStatics(const MachineData& machine, double rake, const Vector3d& load_B)
    : machine_(machine), shovel_(machine, Pose{}, rake), load_B_(load_B) {}

HandleStatics::HandleStatics(const MachineData& machine, double rake)
    : HandleStatics(machine, rake, {machine.dipper.inside.x() / 2, 0, 0}) {}

HandlePlace HandleStatics::at(const Drives& drives) const {
  const ShovelPose X = shovel_.pose({drives.hoist, drives.crowd, 0, 0});
  const auto& m = machine_;
  HandlePlace p;
  p.mass_of_handle_ = m.handle.mass;
  p.mass_of_dipper_ = m.dipper.mass;
  p.mass_of_door_ = m.door.mass;
  p.saddle_ = out_and_up(m.saddle.position);
  p.out_ = Vector2d(std::cos(X.saddle), std::sin(X.saddle));
  const Vector2d bail = out_and_up(X.X_WB * m.dipper.bail), point = out_and_up(m.boom.point);
  p.rope_ =
      sheave_path(out_and_up(m.rope.drum) - point, bail - point, m.boom.sheave_radius).toward_b;
  const Vector2d r = bail - p.saddle_;
  p.arm_ = r.x() * p.rope_.y() - r.y() * p.rope_.x();
  p.handle_ = out_and_up(X.X_WB * m.dipper.handle_end) + m.handle.mass_center * p.out_;
  p.dipper_ = out_and_up(X.X_WB * m.dipper.mass_center);
  p.door_ = out_and_up(X.X_WD * m.door.mass_center);
  p.load_ = out_and_up(X.X_WB * load_B_);
  p.teeth_ = out_and_up(
      X.X_WB * Vector3d(m.dipper.inside.x() + m.dipper.tooth_reach, 0, -m.dipper.inside.z() / 2));
  p.floor_ = out_and_up(X.X_WB.R * Vector3d::UnitX());
  return p;
}

double HandleStatics::load_kg(const Drives& drives, double hoist_N) const {
  const HandlePlace p = at(drives);
  return (p.held({hoist_N, 0}) - p.empty()).moment / p.of_a_kg().moment;
}

}  // namespace dipper::machine
