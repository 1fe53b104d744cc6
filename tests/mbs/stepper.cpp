#include "tests/mbs/stepper.hpp"

#include "common/seconds.hpp"
#include "tests/mbs/runge_kutta.hpp"

namespace dipper::mbs {

void realize_at(const SimTK::MultibodySystem& system, SimTK::State& state, double t_s) {
  if (state.getTime() != t_s) state.setTime(t_s);  // setting it undoes every realization
  if (state.getSystemStage() >= SimTK::Stage::Velocity) {
    system.realize(state, SimTK::Stage::Acceleration);  // the forces changed at most
    return;
  }
  system.realize(state, SimTK::Stage::Time);
  system.prescribeQ(state);
  system.realize(state, SimTK::Stage::Position);
  system.prescribeU(state);
  system.realize(state, SimTK::Stage::Acceleration);
}

void advance(const SimTK::MultibodySystem& system, SimTK::State& state, std::int64_t t0_ns,
             std::int64_t t1_ns, std::int64_t max_substep_ns, const Quadrature& quadrature,
             SimTK::Vector& integrals) {
  const std::int64_t n = (t1_ns - t0_ns + max_substep_ns - 1) / max_substep_ns;
  const double t0 = seconds(t0_ns);
  const double h = seconds(t1_ns - t0_ns) / static_cast<double>(n);

  const int n_q = state.getNQ(), n_u = state.getNU();
  SimTK::Vector y(n_q + n_u + integrals.size()), slope(y.size());
  y(0, n_q) = state.getQ();
  y(n_q, n_u) = state.getU();
  y(n_q + n_u, integrals.size()) = integrals;
  for (std::int64_t i = 0; i < n; ++i) {
    runge_kutta_step(y, t0 + h * static_cast<double>(i), h, [&](const SimTK::Vector& at, double t) {
      state.updQ() = at(0, n_q);
      state.updU() = at(n_q, n_u);
      realize_at(system, state, t);
      slope(0, n_q) = state.getQDot();
      slope(n_q, n_u) = state.getUDot();
      if (integrals.size() > 0) slope(n_q + n_u, integrals.size()) = quadrature(state);
      return slope;
    });
  }
  state.updQ() = y(0, n_q);
  state.updU() = y(n_q, n_u);
  integrals = y(n_q + n_u, integrals.size());
  realize_at(system, state, seconds(t1_ns));
}

}  // namespace dipper::mbs
