#include "mbs/shovel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/seconds.hpp"
#include "machine/kinematics.hpp"
#include "machine/return_legs.hpp"
#include "mbs/operator.hpp"
#include "mbs/runge_kutta.hpp"
#include "mbs/shovel_channels.hpp"
#include "mbs/shovel_dynamics.hpp"
#include "mbs/shovel_model.hpp"
#include "mbs/snapshot.hpp"

namespace dipper::mbs {
namespace {

enum Work { kDriveWork, kInterfaceWork, kDissipated, kWorks };
constexpr int kFixed = 2 * kJoints + kWorks;  ///< numbers before the rope's nodes
using Works = Eigen::Matrix<double, kWorks, 1>;
using Numbers = Eigen::VectorXd;  ///< what is integrated: q, u, works, the rope's nodes

}  // namespace

struct Shovel::Impl {
  Impl(const machine::MachineData& machine_data, machine::Motion motion_in, const Pose& X_W0,
       double rake, std::int64_t max_substep, machine::DriveMode mode, bool contact_on_return)
      : machine(machine_data),
        motion(std::make_shared<const machine::Motion>(std::move(motion_in))),
        path(mode == machine::DriveMode::limited
                 ? std::make_unique<Operator>(motion, machine.limits.crowd_min)
                 : nullptr),
        free_ways(contact_on_return ? std::vector<machine::ReturnLeg>{}
                                    : machine::return_legs(*motion)),
        dynamics(machine, mode, X_W0, rake),
        model(machine, X_W0, rake, dynamics.drum_inertia()),
        max_substep_ns(max_substep),
        substep_ns(static_cast<std::int64_t>(
            std::min(static_cast<double>(max_substep), 1e9 * dynamics.longest_step()))) {
    if (max_substep_ns <= 0) throw std::invalid_argument("shovel: the sub-step must be positive");
    if (motion->start_ns() != 0) {
      throw std::invalid_argument(fmt::format(
          "shovel: the motion starts at {} ns; it must start at 0", motion->start_ns()));
    }
    find_equilibrium(machine::ShovelKinematics(machine, X_W0, rake));
    const Instant start = now(committed);
    energy_at_start = start.kinetic + start.potential;
    if (path) committed.path = {0, 1, 0, 0};
  }

  machine::DriveState sent(double t_s) const { return path ? path->sent(t_s) : motion->at(t_s); }

  Instant now(const Snapshot& at) const {
    return dynamics.at(at.q, at.u, at.rope, sent(seconds(at.t_ns)), at.F_Bo_W);
  }

  /// Where the operator is. His looks of the last window are over.
  void stand_at(const Snapshot& snapshot) {
    if (!path) return;
    path->stand(seconds(snapshot.t_ns),
                {snapshot.path[0], snapshot.path[1], snapshot.path[2], snapshot.path[3]});
  }

  /// dy/dt.
  Numbers rate(const Numbers& y, double t_s, const Wrenches& rock) const {
    const machine::DriveState to = sent(t_s);
    Joints q = y.head<kJoints>(), u = y.segment<kJoints>(kJoints);
    dynamics.prescribe(to, q, u);
    const Instant i = dynamics.at(q, u, y.tail(y.size() - kFixed), to, rock);
    const DriveReport d = dynamics.report(i, i.reaction);
    Numbers dy(y.size());
    dy << u, i.acceleration, d.hoist_power + d.crowd_power + d.swing_power + d.door_power,
        i.rock_power, d.dissipated_power, i.rope_rates;
    return dy;
  }

  static void take_apart(const Numbers& y, Snapshot& to) {
    to.q = y.head<kJoints>();
    to.u = y.segment<kJoints>(kJoints);
    to.works = y.segment<kWorks>(2 * kJoints);
    to.rope = y.tail(y.size() - kFixed);
  }

  /// From `from` with the wrenches of `to`, to the time of `to`.
  void integrate(const Snapshot& from, Snapshot& to) {
    stand_at(from);
    Numbers y(kFixed + from.rope.size());
    y << from.q, from.u, from.works, from.rope;
    const std::int64_t t0_ns = from.t_ns, t1_ns = to.t_ns;
    const std::int64_t looks = (t1_ns - t0_ns + max_substep_ns - 1) / max_substep_ns;
    for (std::int64_t k = 0, t_ns = t0_ns; t_ns < t1_ns; ++k) {
      // Prescribed: one stretch for each piece of the motion, so that no jump of acceleration is
      // inside a step. Limited: one for each look of the operator.
      const std::int64_t next_ns = std::min(
          t1_ns, path ? t0_ns + (t1_ns - t0_ns) * (k + 1) / looks : motion->next_row_ns(t_ns));
      if (path) {
        path->look(seconds(t_ns), [&] {
          Snapshot here;
          take_apart(y, here);
          here.t_ns = t_ns;
          here.F_Bo_W = to.F_Bo_W;
          return now(here).motors->overload();
        });
      }
      const std::int64_t n = (next_ns - t_ns + substep_ns - 1) / substep_ns;
      const double h = seconds(next_ns - t_ns) / static_cast<double>(n);
      for (std::int64_t i = 0; i < n; ++i) {
        runge_kutta_step(y, seconds(t_ns) + h * static_cast<double>(i), h,
                         [&](const Numbers& at, double t_s) { return rate(at, t_s, to.F_Bo_W); });
      }
      t_ns = next_ns;
    }
    take_apart(y, to);
    dynamics.prescribe(sent(seconds(t1_ns)), to.q, to.u);
    if (path) {
      const PathState way = path->at(seconds(t1_ns));
      to.path = {way.time, way.rate, way.relief, way.relief_rate};
    }
  }

  void find_equilibrium(const machine::ShovelKinematics& rigid) {
    // Before the motion starts the drives stand still where they will be at t = 0; an acceleration
    // in the first interval must not tilt the equilibrium.
    const machine::DriveState at_rest{motion->value(0), {}, {}};
    Joints& q = committed.q = dynamics.joints(at_rest.position);
    const auto at = [&](double angle) {
      q[kSaddle] = angle;
      committed.rope = dynamics.settled_rope(q);
      return dynamics.at(q, Joints::Zero(), committed.rope, at_rest, {}, true);
    };
    const auto rises = [&](double angle) { return at(angle).acceleration[kSaddle] > 0; };
    // With the rope just slack it falls.
    double high = rigid.saddle_angle(at_rest.position.hoist, at_rest.position.crowd);
    double low = high - 1e-3;
    while (!rises(low)) {  // until the stretched rope pulls it up
      low -= 1e-3;
      if (high - low > 0.2) {
        throw std::runtime_error("the hoist ropes do not hold the dipper at t = 0");
      }
    }
    double middle = 0.5 * (low + high);
    while (middle > low && middle < high) {
      (rises(middle) ? low : high) = middle;
      middle = 0.5 * (low + high);
    }
    dynamics.hold(at(middle));
    dynamics.prescribe(motion->at(0), q, committed.u);
  }

  /// Throws std::logic_error where Simbody's equations and ours differ.
  Joints held_to_simbody(const Instant& i, const Wrenches& rock) {
    const Joints tau = model.reactions(i.at.q, i.at.u, i.acceleration, i.applied, rock, i.pull);
    const double off = (tau - i.reaction).cwiseAbs().maxCoeff();
    const double scale = i.force.norm() + i.reaction.norm();
    if (!(off <= 1e-8 * scale)) {
      throw std::logic_error(
          fmt::format("Simbody's forces on the joints are off by {:.3g} of {:.3g}", off, scale));
    }
    return tau;
  }

  std::vector<BodyState> bodies(const Snapshot& at) const {
    const auto states = dynamics.tree().bodies(dynamics.tree().place(at.q, at.u));
    return {states.begin(), states.end()};
  }

  bool contact(const Snapshot& at) const {
    const std::int64_t t_ns = path ? std::llround(1e9 * at.path[0]) : at.t_ns;
    return std::none_of(free_ways.begin(), free_ways.end(), [&](const machine::ReturnLeg& way) {
      return way.begin_ns <= t_ns && t_ns < way.end_ns;
    });
  }

  core::MachineState report(const Snapshot& at);

  [[noreturn]] void fail(std::int64_t t0_ns, std::int64_t t1_ns, const std::string& what) const {
    throw std::runtime_error(fmt::format(
        "shovel: {} while stepping from {:.6f} to {:.6f} s (saddle at {:.4f} rad, {:.4f} "
        "rad/s when it began)",
        what, seconds(t0_ns), seconds(t1_ns), committed.q[kSaddle], committed.u[kSaddle]));
  }

  machine::MachineData machine;
  std::shared_ptr<const machine::Motion> motion;
  std::unique_ptr<Operator> path;             ///< none: the drives are prescribed
  std::vector<machine::ReturnLeg> free_ways;  ///< on which the bodies meet no rock
  ShovelDynamics dynamics;
  ShovelModel model;
  std::int64_t max_substep_ns;  ///< from look to look of the operator
  std::int64_t substep_ns;      ///< of the integrator
  Snapshot committed;
  double energy_at_start = 0;
};

Shovel::Shovel(const machine::MachineData& machine, machine::Motion motion, const Pose& X_W0,
               double rake, std::int64_t max_substep_ns, machine::DriveMode mode,
               bool contact_on_return)
    : impl_(std::make_unique<Impl>(machine, std::move(motion), X_W0, rake, max_substep_ns, mode,
                                   contact_on_return)) {}

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

core::MachineState Shovel::Impl::report(const Snapshot& at) {
  const Instant i = now(at);
  const Joints tau = held_to_simbody(i, at.F_Bo_W);
  const DriveReport d = dynamics.report(i, tau);
  const machine::DriveState drive = dynamics.where(at.q, at.u);
  const Works& works = at.works;
  const double residual = i.kinetic + i.potential - energy_at_start - works[kDriveWork] -
                          works[kInterfaceWork] + works[kDissipated];
  core::MachineState out;
  out.t_ns = at.t_ns;
  out.bodies = bodies(at);
  out.contact = contact(at);
  out.channels = {
      // As shovel_channels.cpp names them.
      drive.position.swing,
      drive.rate.swing,
      at.q[kSaddle],
      at.u[kSaddle],
      drive.position.crowd,
      drive.rate.crowd,
      drive.position.door,
      drive.rate.door,
      drive.position.hoist,
      drive.rate.hoist,
      i.rope.tension,
      i.rope.tension,
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
      works[kDriveWork],
      works[kInterfaceWork],
      works[kDissipated],
      residual,
  };
  if (path) {
    const PathState way = path->at(seconds(at.t_ns));
    const auto yes = [](bool is) { return is ? 1.0 : 0.0; };
    out.channels.insert(out.channels.end(),
                        {way.time, way.rate, way.relief, yes(i.motors->hoist.saturated()),
                         yes(i.motors->crowd.saturated()), yes(i.motors->swing.saturated()),
                         yes(i.rope.tension == 0)});
  }
  return out;
}

core::MachineState Shovel::state() {
  impl_->stand_at(impl_->committed);
  return impl_->report(impl_->committed);
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

  Snapshot to;
  to.t_ns = t_end_ns;
  to.F_Bo_W = {F_Bo_W[0], F_Bo_W[1]};
  core::MachineState result;
  try {
    impl_->integrate(impl_->committed, to);
    if (!to.q.allFinite() || !to.u.allFinite() || !to.works.allFinite() || !to.rope.allFinite())
      throw std::runtime_error("the state is not finite");
    if (!commit) return {t_end_ns, impl_->bodies(to), {}};  // channels nobody asks for
    result = impl_->report(to);
  } catch (const std::exception& e) {
    impl_->fail(t0_ns, t_end_ns, e.what());
  }
  impl_->committed = to;
  return result;
}

void Shovel::save(const std::filesystem::path& file) { dipper::mbs::save(impl_->committed, file); }

void Shovel::load(const std::filesystem::path& file) {
  impl_->committed = load_snapshot(file, impl_->committed);
}

}  // namespace dipper::mbs
