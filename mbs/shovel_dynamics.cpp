#include "mbs/shovel_dynamics.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>
#include <utility>

#include "machine/sheave_path.hpp"

namespace dipper::mbs {
namespace {

using Eigen::Vector2d;

// The crowd's buffers: its stall force pushes them in by this much, and they damp what is on the
// slide by this share of critical.
constexpr double kStop_m = 0.01, kStopDamping = 0.3;

JointStop crowd_stop(const machine::MachineData& m) {
  const double stiffness = m.drives.crowd.stall / kStop_m;
  return {m.limits.crowd_min, m.limits.crowd_max, stiffness,
          2 * kStopDamping * std::sqrt(stiffness * (m.handle.mass + m.dipper.mass + m.door.mass))};
}

Vector2d in_plane(const Vector3d& p) { return {p.x(), p.z()}; }

}  // namespace

ShovelDynamics::ShovelDynamics(const machine::MachineData& m, machine::DriveMode mode,
                               const Pose& X_W0, double rake)
    : machine_(m),
      mode_(mode),
      tree_(m, X_W0, rake, drum_inertia()),
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

FreeLength ShovelDynamics::free_length(const machine::DriveState& are) const {
  return {machine_.rope.length_at_zero_hoist + are.position.hoist, are.rate.hoist};
}

Eigen::VectorXd ShovelDynamics::settled_rope(const Joints& q) const {
  if (!segments_) return {};
  const ShovelTree::Placement at = tree_.place(q, Joints::Zero());
  return segments_->settled(in_plane(at.bail.r - machine_.boom.point),
                            free_length(where(q, Joints::Zero())).length, in_plane(at.gravity));
}

double ShovelDynamics::longest_step() const {
  return segments_ ? segments_->longest_step() : std::numeric_limits<double>::infinity();
}

// The upper rope is rigid, so the sheaves turn with the rope paid out, and drum and motors, which a
// prescribed hoist does not feel, with them.
double ShovelDynamics::drum_inertia() const {
  if (mode_ == machine::DriveMode::prescribed) return 0;
  return machine_.drives.hoist_inertia * machine_.boom.sheave_radius * machine_.boom.sheave_radius;
}

Joints ShovelDynamics::joints(const machine::Drives& d) const {
  Joints j;
  j << d.swing, d.hoist / machine_.boom.sheave_radius, 0, d.crowd, d.door;
  return j;
}

machine::DriveState ShovelDynamics::where(const Joints& q, const Joints& u) const {
  const auto drives = [&](const Joints& j) {
    return machine::Drives{machine_.boom.sheave_radius * j[kSheaves], j[kCrowd], j[kSwing],
                           j[kDoor]};
  };
  return {drives(q), drives(u), {}};
}

void ShovelDynamics::prescribe(const machine::DriveState& sent, Joints& q, Joints& u) const {
  const Joints to = joints(sent.position), rate = joints(sent.rate);
  for (const Joint j : {kSwing, kSheaves, kCrowd, kDoor}) {
    if (limited() && j != kDoor) continue;
    q[j] = to[j];
    u[j] = rate[j];
  }
}

Instant ShovelDynamics::at(const Joints& q, const Joints& u, const Eigen::VectorXd& rope,
                           const machine::DriveState& sent, const Wrenches& rock, bool held) const {
  const machine::DriveState are = where(q, u);
  const double R = machine_.boom.sheave_radius;
  Instant now{tree_.place(q, u), {}, {}, Joints::Zero(), Joints::Zero(), {}, {}, 0, 0, 0, {}, {}};

  const Vector2d bail = in_plane(now.at.bail.r - machine_.boom.point),
                 bail_rate = in_plane(now.at.bail.rate);
  Vector2d pull;
  if (segments_) {
    SegmentedRope::Now segments =
        segments_->at(rope, bail, bail_rate, free_length(are), in_plane(now.at.gravity));
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
  const bool prescribed = !limited() || held;
  if (motors_) now.motors = motors_->efforts(sent, are);
  if (limited()) now.applied[kSheaves] += 2 * R * now.rope.winch_pull;
  if (!prescribed) {
    now.applied[kSheaves] += R * now.motors->hoist.force;
    now.applied[kCrowd] +=
        now.motors->crowd.force + crowd_stop_.force(are.position.crowd, are.rate.crowd);
    now.potential += crowd_stop_.energy(are.position.crowd);
    now.applied[kSwing] += now.motors->swing.force;
  }

  const ShovelTree::Equations e = tree_.equations(now.at, rock, now.pull);
  now.rock_power = e.rock_power;
  now.potential += e.potential;
  now.kinetic += 0.5 * u.dot(e.mass * u);
  const Joints force = now.force = e.force + now.applied;
  Joints acceleration = held ? Joints(Joints::Zero()) : joints(sent.acceleration);
  if (prescribed) {
    acceleration[kSaddle] = 0;
    acceleration[kSaddle] =
        (force[kSaddle] - e.mass.row(kSaddle).dot(acceleration)) / e.mass(kSaddle, kSaddle);
  } else {
    static_assert(kDoor == kJoints - 1, "the joints before it are free");
    constexpr int n = kJoints - 1;
    acceleration.head<n>() = e.mass.topLeftCorner<n, n>().llt().solve(
        force.head<n>() - acceleration[kDoor] * e.mass.col(kDoor).head<n>());
  }
  now.acceleration = acceleration;
  now.reaction = e.mass * acceleration - force;
  now.reaction[kSaddle] = 0;
  if (!prescribed) now.reaction.head<kJoints - 1>().setZero();
  return now;
}

DriveReport ShovelDynamics::report(const Instant& now, const Joints& reaction) const {
  const Joints& u = now.at.u;
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
  if (now.motors) d.dissipated_power += crowd_stop_.dissipation(now.at.q[kCrowd], u[kCrowd]);
  return d;
}

void ShovelDynamics::hold(const Instant& at_rest) {
  if (!motors_) return;
  const Joints& tau = at_rest.reaction;
  motors_->set_trims({tau[kSheaves] / machine_.boom.sheave_radius, tau[kCrowd], tau[kSwing], 0});
}

}  // namespace dipper::mbs
