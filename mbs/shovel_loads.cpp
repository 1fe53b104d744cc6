#include "mbs/shovel_loads.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "machine/sheave_path.hpp"

namespace dipper::mbs {
namespace {

using Eigen::Vector2d;

// The crowd's buffers: its stall force compresses them by this length, and their damping is this
// share of critical for the mass on the slide.
constexpr double kStop_m = 0.01, kStopDamping = 0.3;

JointStop crowd_stop(const machine::MachineData& m) {
  const double stiffness = m.drives.crowd.stall / kStop_m;
  return {m.limits.crowd_min, m.limits.crowd_max, stiffness,
          2 * kStopDamping * std::sqrt(stiffness * (m.handle.mass + m.dipper.mass + m.door.mass))};
}

Vector2d in_plane(const Vector3d& p) { return {p.x(), p.z()}; }

}  // namespace

ShovelLoadLaws::ShovelLoadLaws(const machine::MachineData& m, machine::DriveMode mode)
    : machine_(m),
      law_{m.rope.axial_stiffness, m.rope.elastic_fraction, m.rope.damping},
      friction_{m.losses},
      crowd_stop_(crowd_stop(m)) {
  if (mode == machine::DriveMode::limited) motors_.emplace(m);
  if (!m.rope.segmented) return;
  SegmentedRopeSpec spec;
  spec.drum = in_plane(m.rope.drum - m.boom.point);
  spec.radius = m.boom.sheave_radius;
  spec.law = law_;
  spec.elements = m.rope.elements;
  spec.mass_per_length = m.rope.mass_per_length;
  // To where a rope that hangs straight down leaves the sheave.
  spec.over = machine::sheave_path(spec.drum, {spec.radius, -spec.radius}, spec.radius).length -
              spec.radius;
  spec.longest = m.rope.length_at_zero_hoist;
  spec.shortest = m.rope.length_at_zero_hoist + m.limits.hoist_min;
  segments_.emplace(spec);
}

FreeLength ShovelLoadLaws::free_length(const machine::DriveState& are) const {
  return {machine_.rope.length_at_zero_hoist + are.position.hoist, are.rate.hoist};
}

Eigen::VectorXd ShovelLoadLaws::settled_rope(const ShovelPlace& place) const {
  if (!segments_) return {};
  return segments_->settled(in_plane(place.bail - machine_.boom.point),
                            free_length(drives(place.q, Joints::Zero())).length,
                            in_plane(place.gravity));
}

double ShovelLoadLaws::longest_step() const {
  return segments_ ? segments_->longest_step() : std::numeric_limits<double>::infinity();
}

// The upper rope is rigid, so sheaves, drum and motors turn with the rope paid out. A prescribed
// hoist does not include drum and motors.
double ShovelLoadLaws::drum_inertia() const {
  if (!limited()) return 0;
  return machine_.drives.hoist_inertia * machine_.boom.sheave_radius * machine_.boom.sheave_radius;
}

Joints ShovelLoadLaws::joints(const machine::Drives& d) const {
  Joints j;
  j << d.swing, d.hoist / machine_.boom.sheave_radius, 0, d.crowd, d.door;
  return j;
}

machine::DriveState ShovelLoadLaws::drives(const Joints& q, const Joints& u) const {
  const auto of = [&](const Joints& j) {
    return machine::Drives{machine_.boom.sheave_radius * j[kSheaves], j[kCrowd], j[kSwing],
                           j[kDoor]};
  };
  return {of(q), of(u), {}};
}

ShovelLoads ShovelLoadLaws::at(const ShovelPlace& place, const Eigen::VectorXd& rope,
                               const machine::DriveState& to, bool held) const {
  const Joints& u = place.u;
  const machine::DriveState are = drives(place.q, u);
  const double R = machine_.boom.sheave_radius;
  ShovelLoads now{{}, {}, Joints::Zero(), 0, 0, {}, {}};

  const Vector2d bail = in_plane(place.bail - machine_.boom.point),
                 bail_rate = in_plane(place.bail_rate);
  Vector2d pull;
  if (segments_) {
    SegmentedRope::Now segments =
        segments_->at(rope, bail, bail_rate, free_length(are), in_plane(place.gravity));
    now.rope = segments.state;
    now.kinetic = 2 * segments.kinetic;
    now.potential = 2 * segments.potential;
    now.rope_rates = std::move(segments.rates);
    pull = segments.pull;
  } else {
    const machine::SheavePath path =
        machine::sheave_path(in_plane(machine_.rope.drum - machine_.boom.point), bail, R);
    now.rope = law_.at(path.length, -path.toward_b.dot(bail_rate), free_length(are));
    now.potential = 2 * now.rope.elastic_energy;
    pull = now.rope.tension * path.toward_b;
  }
  now.pull = 2 * Vector3d(pull.x(), 0, pull.y());

  now.applied[kSaddle] = -machine_.saddle.damping * u[kSaddle];
  now.applied[kCrowd] = friction_.crowd(are.rate.crowd);
  now.applied[kSheaves] = R * friction_.hoist(2 * now.rope.tension, are.rate.hoist);
  if (!motors_) return now;
  now.applied[kSheaves] += 2 * R * now.rope.winch_pull;
  now.motors = motors_->efforts(to, are);
  if (held) return now;
  now.applied[kSheaves] += R * now.motors->hoist.force;
  now.applied[kCrowd] +=
      now.motors->crowd.force + crowd_stop_.force(are.position.crowd, are.rate.crowd);
  now.potential += crowd_stop_.energy(are.position.crowd);
  now.applied[kSwing] += now.motors->swing.force;
  return now;
}

DriveReport ShovelLoadLaws::report(const ShovelLoads& now, const Joints& q, const Joints& u,
                                   const Joints& reaction) const {
  const double R = machine_.boom.sheave_radius, tension = 2 * now.rope.tension;
  DriveReport d{};
  // The sheaves' inertia sits between the rope and its winch.
  d.hoist_force = tension - reaction[kSheaves] / R;
  d.hoist_power = 2 * now.rope.winch_power + reaction[kSheaves] * u[kSheaves];
  d.crowd_force = reaction[kCrowd];
  d.swing_torque = reaction[kSwing];
  if (now.motors) {
    d.hoist_force = -now.motors->hoist.force;
    d.hoist_power = now.motors->hoist.force * now.motors->hoist.speed;
    d.crowd_force = now.motors->crowd.force;
    d.swing_torque = now.motors->swing.force;
  }
  d.crowd_power = d.crowd_force * u[kCrowd];
  d.swing_power = d.swing_torque * u[kSwing];
  d.door_torque = reaction[kDoor];
  d.door_power = d.door_torque * u[kDoor];
  d.dissipated_power = 2 * now.rope.dissipation +
                       machine_.saddle.damping * u[kSaddle] * u[kSaddle] -
                       friction_.crowd(u[kCrowd]) * u[kCrowd] -
                       friction_.hoist(tension, R * u[kSheaves]) * R * u[kSheaves];
  if (now.motors) d.dissipated_power += crowd_stop_.dissipation(q[kCrowd], u[kCrowd]);
  return d;
}

void ShovelLoadLaws::hold(const Joints& reaction) {
  if (!motors_) return;
  motors_->set_trims(
      {reaction[kSheaves] / machine_.boom.sheave_radius, reaction[kCrowd], reaction[kSwing], 0});
}

}  // namespace dipper::mbs
