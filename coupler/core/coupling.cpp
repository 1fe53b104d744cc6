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

Scheme scheme_from(const std::string& word) {
  if (word == "serial") return Scheme::serial;
  if (word == "corrected") return Scheme::corrected;
  throw std::invalid_argument("scheme '" + word + "': corrected or serial");
}

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
  machine_state_ = machine_.state();
  Window w;
  w.rock = rock_.place(poses(machine_state_));
  w.machine = machine_state_;
  w.V_WB_wall.resize(machine_state_.bodies.size());
  state_.held.assign(machine_state_.bodies.size(), Wrench{});
  state_.walls.clear();
  for (std::size_t b = 0; b < machine_state_.bodies.size(); ++b) {
    state_.walls.push_back({machine_state_.bodies[b].X_WB, Twist{}, w.rock.bodies[b].end});
  }
  return w;
}

void Coupling::tell_time() {
  const SyncTime now{state_.step_index, t_ns()};
  machine_.set_sync_time(now);
  rock_.set_sync_time(now);
}

void Coupling::resume(CouplingState state) {
  state_ = std::move(state);
  tell_time();
  machine_state_ = machine_.state();
}

Window Coupling::advance(std::int64_t n_steps) {
  const std::int64_t t_end_ns = (state_.dem_step + n_steps) * dt_ns_;
  const double H = static_cast<double>(n_steps * dt_ns_) * 1e-9;
  const std::vector<Wrench>& held = state_.held;
  const std::size_t n = held.size();

  Window w;
  w.step_index = state_.step_index + 1;
  const MachineState first = machine_.step(t_end_ns, held, scheme_ == Scheme::serial);
  rock_.set_contact(machine_state_.contact);
  w.rock = rock_.step(n_steps, poses(first));
  std::vector<Wrench> felt(n);
  for (std::size_t b = 0; b < n; ++b) felt[b] = w.rock.bodies[b].mean;
  const std::vector<Wrench>& applied = scheme_ == Scheme::serial ? held : felt;
  w.machine = scheme_ == Scheme::serial ? first : machine_.step(t_end_ns, felt, true);

  for (std::size_t b = 0; b < n; ++b) {
    // The wall's twist is constant over the window, so mean wrench times twist times H is the
    // rock's work exactly; the machine's wrench is constant, so its work is the wrench times the
    // displacement (the rotation vector's error is third order in the window's turn).
    w.V_WB_wall.push_back(twist_between(state_.walls[b].X_WB, w.rock.bodies[b].X_WB, H));
    w.rock_work_J += power(felt[b], w.V_WB_wall[b]) * H;
    w.machine_work_J += power(applied[b], twist_between(machine_state_.bodies[b].X_WB,
                                                        w.machine.bodies[b].X_WB, H)) *
                        H;
    state_.walls[b] = {w.rock.bodies[b].X_WB, w.V_WB_wall[b], w.rock.bodies[b].end};
  }
  state_.held = std::move(felt);
  state_.step_index = w.step_index;
  state_.dem_step += n_steps;
  machine_state_ = w.machine;
  tell_time();
  return w;
}

}  // namespace dipper::core
