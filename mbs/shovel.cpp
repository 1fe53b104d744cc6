#include "mbs/shovel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/seconds.hpp"
#include "machine/kinematics.hpp"
#include "machine/motion_row.hpp"
#include "machine/return_legs.hpp"
#include "mbs/path_follower.hpp"
#include "mbs/shovel_channels.hpp"
#include "mbs/shovel_system.hpp"
#include "mbs/snapshot.hpp"

namespace dipper::mbs {
namespace {

/// A step ends at a row of the motion, or when the operator updates its set points.
std::int64_t pieces(std::int64_t length_ns, std::int64_t longest_ns) {
  return (length_ns + longest_ns - 1) / longest_ns;
}

}  // namespace

struct Shovel::Impl {
  Impl(const machine::MachineData& machine, std::shared_ptr<machine::Motion> motion_in,
       const Pose& X_W0, double rake, std::unique_ptr<Operator> from, std::int64_t max_substep,
       bool contact_on_return_in)
      : begun(*motion_in),
        motion(std::move(motion_in)),
        sender(std::move(from)),
        contact_on_return(contact_on_return_in),
        return_legs(contact_on_return ? std::vector<machine::ReturnLeg>{}
                                      : machine::return_legs(*motion)),
        max_substep_ns(max_substep),
        system(machine, sender ? machine::DriveMode::limited : machine::DriveMode::prescribed, X_W0,
               rake, seconds(max_substep),
               [this](double t_s) { return sender ? sender->setpoint(t_s) : motion->at(t_s); }) {
    if (max_substep_ns <= 0) throw std::invalid_argument("shovel: the sub-step must be positive");
    if (motion->start_ns() != 0) {
      throw std::invalid_argument(fmt::format(
          "shovel: the motion starts at {} ns; it must start at 0", motion->start_ns()));
    }
    const machine::Drives start = motion->value(0);
    const machine::ShovelKinematics rigid(machine, X_W0, rake);
    // The drives are at rest; an acceleration in the motion's first interval must not affect the
    // equilibrium.
    committed.numbers =
        system.find_equilibrium(start, rigid.saddle_angle(start.hoist, start.crowd));
    if (sender) {
      committed.drives = sender->kind();
      committed.sender = sender->state(0);
    }
    restore();
    const ShovelInstant i = system.instant();
    energy_at_start = i.kinetic + i.potential;
  }

  /// Sets the system to its committed state.
  void restore() {
    if (sender) sender->reset(seconds(committed.t_ns), committed.sender);
    system.set(seconds(committed.t_ns), committed.numbers);
    system.hold(committed.F_Bo_W);
  }

  void take(const core::Order& order) {
    if (!sender) throw std::invalid_argument("an order for prescribed drives");
    sender->take(seconds(committed.t_ns), order);
    system.set_points_changed();
  }

  /// Integrates from the committed state, with the wrenches of `to`, to the time of `to`.
  void integrate(Snapshot& to) {
    const std::int64_t t0_ns = committed.t_ns, t1_ns = to.t_ns;
    const std::int64_t looks = pieces(t1_ns - t0_ns, max_substep_ns);
    std::int64_t t_ns = t0_ns;
    for (std::int64_t k = 1; t_ns < t1_ns; ++k) {
      // Prescribed: one interval for each row of the motion, so that no jump of acceleration is
      // inside a step. Limited: one for each update of the operator.
      const std::int64_t next_ns =
          std::min(t1_ns, sender ? t0_ns + (t1_ns - t0_ns) * k / looks : motion->next_row_ns(t_ns));
      if (sender) {
        sender->update(seconds(t_ns), [&] {
          const DriveEfforts motors = *system.loads().motors;
          const ShovelNumbers n = system.numbers();
          return Felt{system.laws().drives(n.q, n.u), motors};
        });
        system.set_points_changed();
      }
      if (k == 1) system.hold(to.F_Bo_W);
      system.step_to(seconds(next_ns));
      t_ns = next_ns;
    }
    to.numbers = system.numbers();
    if (sender) to.sender = sender->state(seconds(t1_ns));
  }

  bool contact(const Snapshot& at) const {
    if (return_legs.empty()) return true;
    const auto motion_s = sender ? sender->motion_s(seconds(at.t_ns)) : std::nullopt;
    const std::int64_t t_ns = motion_s ? std::llround(1e9 * *motion_s) : at.t_ns;
    return std::none_of(return_legs.begin(), return_legs.end(), [&](const machine::ReturnLeg& leg) {
      return leg.begin_ns <= t_ns && t_ns < leg.end_ns;
    });
  }

  core::MachineState report(const Snapshot& at, std::int64_t t_next_ns);

  [[noreturn]] void fail(std::int64_t t0_ns, std::int64_t t1_ns, const std::string& what) const {
    throw std::runtime_error(fmt::format(
        "shovel: {} while stepping from {:.6f} to {:.6f} s (saddle at {:.4f} rad, {:.4f} "
        "rad/s when it began)",
        what, seconds(t0_ns), seconds(t1_ns), committed.numbers.q[kSaddle],
        committed.numbers.u[kSaddle]));
  }

  /// The motion goes on with these rows after those it has begun with. The operator has the same
  /// motion.
  void follow(const std::string& rows) {
    machine::Motion whole = begun;
    if (!rows.empty()) whole.extend(machine::Motion::parse(rows, "the rows to follow"));
    *motion = std::move(whole);
    if (!contact_on_return) return_legs = machine::return_legs(*motion);
    system.set_points_changed();
  }

  machine::Motion begun;  ///< what it was started with
  std::shared_ptr<machine::Motion> motion;
  std::unique_ptr<Operator> sender;  ///< none: the drives are prescribed
  bool contact_on_return;
  std::vector<machine::ReturnLeg> return_legs;  ///< on which the bodies meet no rock
  std::int64_t max_substep_ns;  ///< of the integrator, and between the operator's updates
  ShovelSystem system;
  Snapshot committed;
  double energy_at_start = 0;
};

Shovel::Shovel(const machine::MachineData& machine, std::shared_ptr<machine::Motion> motion,
               const Pose& X_W0, double rake, std::unique_ptr<Operator> from,
               std::int64_t max_substep_ns, bool contact_on_return)
    : impl_(std::make_unique<Impl>(machine, std::move(motion), X_W0, rake, std::move(from),
                                   max_substep_ns, contact_on_return)) {}

Shovel::Shovel(const machine::MachineData& machine, machine::Motion motion, const Pose& X_W0,
               double rake, std::int64_t max_substep_ns, machine::DriveMode mode,
               bool contact_on_return) {
  auto way = std::make_shared<machine::Motion>(std::move(motion));
  std::unique_ptr<Operator> follower;
  if (mode == machine::DriveMode::limited)
    follower = std::make_unique<PathFollower>(way, machine.limits.crowd_min);
  impl_ = std::make_unique<Impl>(machine, std::move(way), X_W0, rake, std::move(follower),
                                 max_substep_ns, contact_on_return);
}

Shovel::~Shovel() = default;

core::ServerInfo Shovel::info() const {
  int major = 0, minor = 0, build = 0;
  SimTK_version_simbody(&major, &minor, &build);
  core::ServerInfo info;
  info.version = fmt::format("dipper-mbs, Simbody {}.{}.{}", major, minor, build);
  info.bodies = {"dipper", "door"};
  info.timestep_s = seconds(impl_->max_substep_ns);
  info.channels = shovel_channels(impl_->sender.get());
  return info;
}

core::MachineState Shovel::Impl::report(const Snapshot& at, std::int64_t t_next_ns) {
  const ShovelInstant i = system.instant();
  const auto& [q, u, works, rope] = at.numbers;
  const machine::DriveState drive = system.laws().drives(q, u);
  const DriveReport& d = i.drives;
  const double residual =
      i.kinetic + i.potential - energy_at_start - works[0] - works[1] + works[2];
  core::MachineState out;
  out.t_ns = at.t_ns;
  const auto bodies = system.bodies();
  out.bodies.assign(bodies.begin(), bodies.end());
  if (t_next_ns > at.t_ns) {
    const auto next = system.poses_in(seconds(t_next_ns - at.t_ns));
    out.X_WB_next.assign(next.begin(), next.end());
  }
  out.contact = contact(at);
  out.channels = {
      // In the order of shovel_channels.cpp.
      drive.position.swing,
      drive.rate.swing,
      q[kSaddle],
      u[kSaddle],
      drive.position.crowd,
      drive.rate.crowd,
      drive.position.door,
      drive.rate.door,
      drive.position.hoist,
      drive.rate.hoist,
      i.loads.rope.tension,
      i.loads.rope.tension,
      d.hoist_force,
      d.crowd_force,
      d.swing_torque,
      d.door_torque,
      d.hoist_power,
      d.crowd_power,
      d.swing_power,
      d.door_power,
      i.kinetic,
      i.potential,
      i.rock_power,
      d.dissipated_power,
      works[0],
      works[1],
      works[2],
      residual,
  };
  if (sender) {
    const DriveEfforts& motors = *i.loads.motors;
    const std::vector<double> sent = sender->values(seconds(at.t_ns), motors);
    out.channels.insert(out.channels.end(), sent.begin(), sent.end());
    const auto yes = [](bool is) { return is ? 1.0 : 0.0; };
    out.channels.insert(out.channels.end(),
                        {yes(motors.hoist.saturated()), yes(motors.crowd.saturated()),
                         yes(motors.swing.saturated()), yes(i.loads.rope.tension == 0)});
  }
  return out;
}

core::MachineState Shovel::state(std::int64_t t_next_ns) {
  return impl_->report(impl_->committed, t_next_ns);
}

core::MachineState Shovel::step(const core::MachineStep& step) {
  const std::int64_t t0_ns = impl_->committed.t_ns;
  if (step.t_end_ns <= t0_ns) {
    throw std::invalid_argument(
        fmt::format("shovel: a sync step must go forward; the time is {} ns, its end {} ns", t0_ns,
                    step.t_end_ns));
  }
  if (step.F_Bo_W.size() != kBodies) {
    throw std::invalid_argument(fmt::format("shovel: {} wrenches; there must be {}: dipper, door",
                                            step.F_Bo_W.size(), kBodies));
  }
  for (std::size_t i = 0; i < kBodies; ++i) {
    if (!is_finite(step.F_Bo_W[i])) {
      impl_->fail(t0_ns, step.t_end_ns,
                  fmt::format("the wrench on the {} is not finite", i == 0 ? "dipper" : "door"));
    }
  }
  Snapshot to;
  to.drives = impl_->committed.drives;
  to.rows = impl_->committed.rows;
  to.t_ns = step.t_end_ns;
  to.F_Bo_W = {step.F_Bo_W[0], step.F_Bo_W[1]};
  core::MachineState result;
  try {
    if (!step.order.to.empty()) impl_->take(step.order);
    impl_->integrate(to);
    const ShovelNumbers& n = to.numbers;
    if (!n.q.allFinite() || !n.u.allFinite() || !n.works.allFinite() || !n.rope.allFinite())
      throw std::runtime_error("the state is not finite");
    result = impl_->report(to, step.t_next_ns);
  } catch (const std::exception& e) {
    impl_->restore();
    impl_->fail(t0_ns, step.t_end_ns, e.what());
  }
  impl_->committed = to;
  return result;
}

void Shovel::save(const std::filesystem::path& file) { dipper::mbs::save(impl_->committed, file); }

void Shovel::load(const std::filesystem::path& file) {
  impl_->committed = load_snapshot(file, impl_->committed);
  impl_->follow(impl_->committed.rows);
  impl_->restore();
}

void Shovel::follow(const std::string& rows) {
  std::string all = impl_->committed.rows.empty() ? machine::kMotionHead : impl_->committed.rows;
  impl_->follow(all += rows);
  impl_->committed.rows = std::move(all);
}

}  // namespace dipper::mbs
