#include "coupler/core/coupling.hpp"

#include <cmath>
#include <stdexcept>

namespace dipper::core {
namespace {

std::vector<Pose> poses(const MachineState& s) {
  std::vector<Pose> X;
  for (const auto& b : s.bodies) X.push_back(b.X_WB);
  return X;
}

}  // namespace

Coupling::Coupling(Machine& machine, Rock& rock, Scheme scheme)
    : machine_(machine),
      rock_(rock),
      scheme_(scheme),
      dt_ns_(std::llround(rock.info().timestep_s * 1e9)) {
  if (machine.info().bodies != rock.info().bodies) {
    throw std::runtime_error("the machine and the rock do not have the same bodies");
  }
}

Window Coupling::start() {
  machine_state_ = machine_.state(0);
  Window w;
  w.rock = rock_.place(poses(machine_state_));
  w.machine = machine_state_;
  state_.held.assign(machine_state_.bodies.size(), Wrench{});
  state_.walls.clear();
  for (std::size_t b = 0; b < machine_state_.bodies.size(); ++b) {
    state_.walls.push_back({machine_state_.bodies[b].X_WB, Twist{}, w.rock.bodies[b].end});
  }
  return w;
}

void Coupling::resume(CouplingState state) {
  state_ = std::move(state);
  next_ns_ = t_ns();
  machine_state_ = machine_.state(next_ns_);
}

void Coupling::begin(std::int64_t n_steps) {
  const std::int64_t t_end_ns = (state_.dem_step + n_steps) * dt_ns_;
  under_way_ = n_steps;
  RockStep step{n_steps, {}, machine_state_.contact, t_end_ns, state_.step_index};
  if (scheme_ == Scheme::serial) {
    stepped_ = machine_.step({t_end_ns, state_.held, t_end_ns, state_.step_index});
    step.X_WB_target = poses(stepped_);
  } else {
    if (next_ns_ != t_end_ns) machine_state_ = machine_.state(t_end_ns);
    step.X_WB_target = machine_state_.X_WB_next;
  }
  rock_.start(step);
}

Window Coupling::finish(std::int64_t n_next) {
  const std::int64_t t_end_ns = (state_.dem_step + under_way_) * dt_ns_;
  const double H = static_cast<double>(under_way_ * dt_ns_) * 1e-9;
  const std::size_t n = state_.walls.size();

  Window w;
  w.step_index = state_.step_index + 1;
  w.rock = rock_.finish();
  std::vector<Wrench> felt(n);
  for (std::size_t b = 0; b < n; ++b) felt[b] = w.rock.bodies[b].mean;
  const std::vector<Wrench>& applied = scheme_ == Scheme::serial ? state_.held : felt;
  next_ns_ = t_end_ns + n_next * dt_ns_;
  w.machine = scheme_ == Scheme::serial
                  ? std::move(stepped_)
                  : machine_.step({t_end_ns, felt, next_ns_, state_.step_index});

  for (std::size_t b = 0; b < n; ++b) {
    // The wall's twist is constant over the window, so mean wrench times twist times H is the
    // rock's work exactly. The machine's wrench is constant, so its work is wrench times
    // displacement (the error of the rotation vector is third order in the window's rotation).
    // The constant twist of the wall.
    const Twist V_WB = twist_between(state_.walls[b].X_WB, w.rock.bodies[b].X_WB, H);
    w.rock_work_J += power(felt[b], V_WB) * H;
    w.machine_work_J += power(applied[b], twist_between(machine_state_.bodies[b].X_WB,
                                                        w.machine.bodies[b].X_WB, H)) *
                        H;
    state_.walls[b] = {w.rock.bodies[b].X_WB, V_WB, w.rock.bodies[b].end};
  }
  state_.held = std::move(felt);
  state_.step_index = w.step_index;
  state_.dem_step += under_way_;
  machine_state_ = w.machine;
  return w;
}

}  // namespace dipper::core
