#include "mbs/shovel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "common/seconds.hpp"
#include "machine/kinematics.hpp"
#include "mbs/convert.hpp"
#include "mbs/operator.hpp"
#include "mbs/prescribed.hpp"
#include "mbs/shovel_channels.hpp"
#include "mbs/shovel_model.hpp"
#include "mbs/snapshot.hpp"
#include "mbs/stepper.hpp"

namespace dipper::mbs {
namespace {

using SimTK::SpatialVec;
using SimTK::State;

constexpr std::size_t kBodies = 2;  // dipper, door
enum Work { kDriveWork, kInterfaceWork, kDissipated, kWorks };

/// What the drives do at one instant.
struct DriveReport {
  RopeState left, right;
  double hoist_force, crowd_force, swing_torque, door_torque;
  double hoist_power, crowd_power, swing_power, door_power;
  double interface_power, dissipated_power;
};

}  // namespace

struct Shovel::Impl {
  Impl(const machine::MachineData& machine_data, machine::Motion motion_in, const Pose& X_W0,
       double rake, std::int64_t max_substep, machine::DriveMode mode)
      : machine(machine_data),
        motion(std::make_shared<const machine::Motion>(std::move(motion_in))),
        path(mode == machine::DriveMode::limited
                 ? std::make_unique<Operator>(motion, machine.limits.crowd_min)
                 : nullptr),
        model(
            machine, [this](double t_s) { return path ? path->sent(t_s) : motion->at(t_s); }, mode,
            X_W0, rake),
        max_substep_ns(max_substep),
        scratch(model.initial) {
    if (max_substep_ns <= 0) throw std::invalid_argument("shovel: the sub-step must be positive");
    if (motion->start_ns() != 0) {
      throw std::invalid_argument(fmt::format(
          "shovel: the motion starts at {} ns; it must start at 0", motion->start_ns()));
    }
    find_equilibrium(machine::ShovelKinematics(machine, X_W0, rake));
    energy_at_start = energy(scratch);
    remember(0, SimTK::Vector(kWorks, 0.0), {});
  }

  double energy(const State& s) const { return model.system.calcEnergy(s); }

  const SimTK::MobilizedBody& body(std::size_t i) const {
    return i == 0 ? model.dipper : model.door;
  }

  void remember(std::int64_t t_ns, const SimTK::Vector& works,
                const std::array<Wrench, kBodies>& F_Bo_W) {
    committed = {t_ns, scratch.getQ(), scratch.getU(), works, {}, F_Bo_W};
    if (path) {
      const PathState at = path->at(seconds(t_ns));
      committed.path = SimTK::Vector(SimTK::Vec4(at.time, at.rate, at.relief, at.relief_rate));
    }
    scratch_is_committed = true;
  }

  /// Puts a snapshot into the scratch State. Where it is already (the usual case after a commit),
  /// what was realized from q and u stays.
  void restore(const Snapshot& snapshot) {
    hold(snapshot.F_Bo_W);
    if (path) {
      path->stand(seconds(snapshot.t_ns),
                  {snapshot.path[0], snapshot.path[1], snapshot.path[2], snapshot.path[3]});
      forget_forces();
    }
    if (scratch_is_committed) return;
    scratch.setTime(seconds(snapshot.t_ns));
    scratch.updQ() = snapshot.q;
    scratch.updU() = snapshot.u;
  }

  void hold(const std::array<Wrench, kBodies>& F_Bo_W) {
    held = F_Bo_W;
    for (std::size_t i = 0; i < kBodies; ++i) {
      model.rock.setOneBodyForce(scratch, body(i),
                                 SpatialVec(vec(F_Bo_W[i].torque), vec(F_Bo_W[i].force)));
    }
  }

  /// What was realized with another stretch of the operator's way.
  void forget_forces() { scratch.invalidateAllCacheAtOrAbove(SimTK::Stage::Dynamics); }

  /// Integrates from t0 to t1.
  void integrate(std::int64_t t0_ns, std::int64_t t1_ns, SimTK::Vector& works) {
    const std::int64_t looks = (t1_ns - t0_ns + max_substep_ns - 1) / max_substep_ns;
    for (std::int64_t k = 0, t_ns = t0_ns; t_ns < t1_ns; ++k) {
      // Prescribed: one stretch for each piece of the motion, so that no jump of acceleration is
      // inside a step. Limited: one for each look of the operator.
      const std::int64_t next_ns = std::min(
          t1_ns, path ? t0_ns + (t1_ns - t0_ns) * (k + 1) / looks : motion->next_row_ns(t_ns));
      if (path) {
        path->look(seconds(t_ns), [this] { return model.limited->overload(scratch); });
        forget_forces();
      }
      advance(
          model.system, scratch, t_ns, next_ns, max_substep_ns,
          [this](const State& s) { return powers(s); }, works);
      t_ns = next_ns;
    }
  }

  double saddle_acceleration(double angle) {
    scratch.updU() = 0;
    model.saddle.setOneQ(scratch, 0, angle);
    // Before the motion starts the drives stand still where they will be at t = 0; an acceleration
    // in the first interval must not tilt the equilibrium.
    realize_at(model.system, scratch, -1.0);
    return model.saddle.getOneUDot(scratch, 0);
  }

  void find_equilibrium(const machine::ShovelKinematics& rigid) {
    hold({});
    const machine::Drives at_rest = motion->value(0);
    lock_drives(at_rest);
    double high = rigid.saddle_angle(at_rest.hoist, at_rest.crowd);  // rope just slack: falls
    double low = high - 1e-3;
    while (saddle_acceleration(low) <= 0) {  // until the stretched rope pulls it up
      low -= 1e-3;
      if (high - low > 0.2) {
        throw std::runtime_error("the hoist ropes do not hold the dipper at t = 0");
      }
    }
    while (true) {
      const double middle = 0.5 * (low + high);
      if (middle <= low || middle >= high) break;
      (saddle_acceleration(middle) > 0 ? low : high) = middle;
    }
    unlock_drives();
    realize_at(model.system, scratch, 0.0);
  }

  std::array<SimTK::MobilizedBody*, 3> driven() {
    return {&model.sheaves, &model.handle, &model.house};
  }

  /// Limited drives stand still where they will be at t = 0, as prescribed ones do by themselves.
  void lock_drives(const machine::Drives& at) {
    if (!path) return;
    model.sheaves.setOneQ(scratch, 0, at.hoist / machine.boom.sheave_radius);
    model.handle.setOneQ(scratch, 0, at.crowd);
    model.house.setOneQ(scratch, 0, at.swing);
    for (SimTK::MobilizedBody* joint : driven()) joint->lock(scratch);
  }

  /// From here on the motors hold them.
  void unlock_drives() {
    if (!path) return;
    const SimTK::Vector tau = drive_forces(model.matter, scratch);
    const auto of = [&](const SimTK::MobilizedBody& joint) {
      return tau[joint.getFirstUIndex(scratch)];
    };
    model.limited->set_trims(
        {of(model.sheaves) / machine.boom.sheave_radius, of(model.handle), of(model.house), 0});
    for (SimTK::MobilizedBody* joint : driven()) joint->unlock(scratch);
  }

  DriveReport drives(const State& s) const {
    DriveReport d{};
    const SimTK::Vector tau = drive_forces(model.matter, s);
    const auto of = [&](const SimTK::MobilizedBody& joint) { return tau[joint.getFirstUIndex(s)]; };
    const auto speed = [&](const SimTK::MobilizedBody& joint) { return joint.getOneU(s, 0); };
    d.left = model.rope_left->evaluate(s);
    d.right = model.rope_right->evaluate(s);
    // The sheaves' inertia sits between the rope and its winch.
    d.hoist_force =
        d.left.tension + d.right.tension - of(model.sheaves) / machine.boom.sheave_radius;
    d.hoist_power =
        d.left.winch_power + d.right.winch_power + of(model.sheaves) * speed(model.sheaves);
    d.crowd_force = of(model.handle);
    d.swing_torque = of(model.house);
    if (model.limited != nullptr) {
      const DriveEffort hoist = model.limited->hoist(s);
      d.hoist_force = -hoist.force;
      d.hoist_power = hoist.force * hoist.speed;
      d.crowd_force = model.limited->crowd(s).force;
      d.swing_torque = model.limited->swing(s).force;
    }
    d.crowd_power = d.crowd_force * speed(model.handle);
    d.swing_power = d.swing_torque * speed(model.house);
    d.door_torque = of(model.door);
    d.door_power = d.door_torque * speed(model.door);
    for (std::size_t i = 0; i < kBodies; ++i) {
      const SpatialVec& V = body(i).getBodyVelocity(s);
      d.interface_power += held[i].torque.dot(vec(V[0])) + held[i].force.dot(vec(V[1]));
    }
    const double saddle_rate = speed(model.saddle);
    d.dissipated_power = d.left.dissipation + d.right.dissipation +
                         machine.saddle.damping * saddle_rate * saddle_rate +
                         model.friction->dissipation(s);
    return d;
  }

  SimTK::Vector powers(const State& s) const {
    const DriveReport d = drives(s);
    SimTK::Vector p(kWorks);
    p[kDriveWork] = d.hoist_power + d.crowd_power + d.swing_power + d.door_power;
    p[kInterfaceWork] = d.interface_power;
    p[kDissipated] = d.dissipated_power;
    return p;
  }

  /// Of the scratch State, realized to Velocity.
  std::vector<BodyState> body_states() const {
    std::vector<BodyState> states;
    for (std::size_t i = 0; i < kBodies; ++i) {
      const SpatialVec& V = body(i).getBodyVelocity(scratch);
      states.push_back({pose(body(i).getBodyTransform(scratch)), {vec(V[0]), vec(V[1])}});
    }
    return states;
  }

  /// Of the scratch State, realized to Acceleration.
  core::MachineState report(std::int64_t t_ns, const SimTK::Vector& works) const;

  [[noreturn]] void fail(std::int64_t t0_ns, std::int64_t t1_ns, const std::string& what) const {
    throw std::runtime_error(fmt::format(
        "shovel: {} while stepping from {:.6f} to {:.6f} s (saddle at {:.4f} rad, {:.4f} "
        "rad/s when it began)",
        what, seconds(t0_ns), seconds(t1_ns), committed.q[model.saddle.getFirstQIndex(scratch)],
        committed.u[model.saddle.getFirstUIndex(scratch)]));
  }

  machine::MachineData machine;
  std::shared_ptr<const machine::Motion> motion;
  std::unique_ptr<Operator> path;  ///< none: the drives are prescribed
  ShovelModel model;
  std::int64_t max_substep_ns;
  State scratch;
  bool scratch_is_committed = false;  ///< scratch's t, q, u are committed's, realized
  std::array<Wrench, kBodies> held;
  Snapshot committed;
  double energy_at_start = 0;
};

Shovel::Shovel(const machine::MachineData& machine, machine::Motion motion, const Pose& X_W0,
               double rake, std::int64_t max_substep_ns, machine::DriveMode mode)
    : impl_(std::make_unique<Impl>(machine, std::move(motion), X_W0, rake, max_substep_ns, mode)) {}

Shovel::~Shovel() = default;

core::ServerInfo Shovel::info() const {
  int major = 0, minor = 0, build = 0;
  SimTK_version_simbody(&major, &minor, &build);
  core::ServerInfo info;
  info.version = fmt::format("dipper-mbs, Simbody {}.{}.{}", major, minor, build);
  info.bodies = {"dipper", "door"};
  info.timestep_s = seconds(impl_->max_substep_ns);
  info.channels = shovel_channels(impl_->path != nullptr);
  return info;
}

core::MachineState Shovel::Impl::report(std::int64_t t_ns, const SimTK::Vector& works) const {
  const State& s = scratch;
  core::MachineState out;
  out.t_ns = t_ns;
  out.bodies = body_states();
  const DriveReport d = drives(s);
  machine::DriveState drive = motion->at(seconds(t_ns));
  if (model.limited != nullptr) {
    drive = model.limited->where(s);
    drive.position.door = model.door.getOneQ(s, 0);
    drive.rate.door = model.door.getOneU(s, 0);
  }
  const double kinetic = model.system.calcKineticEnergy(s);
  const double potential = model.system.calcPotentialEnergy(s);
  const double residual = kinetic + potential - energy_at_start - works[kDriveWork] -
                          works[kInterfaceWork] + works[kDissipated];
  out.channels = {
      // As shovel_channels.cpp names them.
      drive.position.swing,
      drive.rate.swing,
      model.saddle.getOneQ(s, 0),
      model.saddle.getOneU(s, 0),
      drive.position.crowd,
      drive.rate.crowd,
      drive.position.door,
      drive.rate.door,
      drive.position.hoist,
      drive.rate.hoist,
      d.left.tension,
      d.right.tension,
      d.hoist_force,
      d.crowd_force,
      d.swing_torque,
      d.door_torque,
      d.hoist_power,
      d.crowd_power,
      d.swing_power,
      d.door_power,
      kinetic,
      potential,
      d.interface_power,
      d.dissipated_power,
      works[kDriveWork],
      works[kInterfaceWork],
      works[kDissipated],
      residual,
  };
  if (path) {
    const PathState at = path->at(seconds(t_ns));
    const auto yes = [](bool is) { return is ? 1.0 : 0.0; };
    out.channels.insert(
        out.channels.end(),
        {at.time, at.rate, at.relief, yes(model.limited->hoist(s).saturated()),
         yes(model.limited->crowd(s).saturated()), yes(model.limited->swing(s).saturated()),
         yes(d.left.tension + d.right.tension == 0)});
  }
  return out;
}

core::MachineState Shovel::state() {
  impl_->restore(impl_->committed);
  realize_at(impl_->model.system, impl_->scratch, seconds(impl_->committed.t_ns));
  impl_->scratch_is_committed = true;
  return impl_->report(impl_->committed.t_ns, impl_->committed.works);
}

core::MachineState Shovel::step(std::int64_t t_end_ns, const std::vector<Wrench>& F_Bo_W,
                                bool commit) {
  const std::int64_t t0_ns = impl_->committed.t_ns;
  if (t_end_ns <= t0_ns) {
    throw std::invalid_argument(fmt::format(
        "shovel: a window must go forward; it is at {} ns and asked for {} ns", t0_ns, t_end_ns));
  }
  if (F_Bo_W.size() != kBodies) {
    throw std::invalid_argument(
        fmt::format("shovel: {} wrenches; there must be {}: dipper, door", F_Bo_W.size(), kBodies));
  }
  for (std::size_t i = 0; i < kBodies; ++i) {
    if (!is_finite(F_Bo_W[i])) {
      impl_->fail(t0_ns, t_end_ns,
                  fmt::format("the wrench on the {} is not finite", i == 0 ? "dipper" : "door"));
    }
  }

  Snapshot from = impl_->committed;
  from.F_Bo_W = {F_Bo_W[0], F_Bo_W[1]};
  SimTK::Vector works = commit ? from.works : SimTK::Vector();  // of a prediction nobody asks
  try {
    impl_->restore(from);
    impl_->scratch_is_committed = false;
    impl_->integrate(t0_ns, t_end_ns, works);
  } catch (const std::exception& e) {
    impl_->fail(t0_ns, t_end_ns, e.what());
  }
  if (!is_finite(impl_->scratch.getQ()) || !is_finite(impl_->scratch.getU()) || !is_finite(works)) {
    impl_->fail(t0_ns, t_end_ns, "the state is not finite");
  }
  if (!commit) return {t_end_ns, impl_->body_states(), {}};
  core::MachineState result = impl_->report(t_end_ns, works);
  impl_->remember(t_end_ns, works, from.F_Bo_W);
  return result;
}

void Shovel::save(const std::filesystem::path& file) { dipper::mbs::save(impl_->committed, file); }

void Shovel::load(const std::filesystem::path& file) {
  impl_->committed = load_snapshot(file, impl_->committed);
  impl_->scratch_is_committed = false;
}

}  // namespace dipper::mbs
