#include "mbs/stepper.hpp"

#include "common/seconds.hpp"

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

  for (std::int64_t i = 0; i < n; ++i) {
    const double t = t0 + h * static_cast<double>(i);
    const SimTK::Vector q0 = state.getQ();
    const SimTK::Vector u0 = state.getU();
    SimTK::Vector dq(q0.size(), 0.0), du(u0.size(), 0.0), dz(integrals.size(), 0.0);
    SimTK::Vector q_dot, u_dot;
    // The classic tableau: at 0, 1/2, 1/2, 1 of the step, with weights 1 2 2 1 sixths.
    // A picosecond early at the end: far above a double's resolution there, and far below anything
    // the motion notices, but on this side of a jump in the prescribed accelerations.
    constexpr double early_s = 1e-12;
    constexpr double at[4] = {0.0, 0.5, 0.5, 1.0};
    constexpr double weight[4] = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
    for (int k = 0; k < 4; ++k) {
      if (k > 0) {
        state.updQ() = q0 + (at[k] * h) * q_dot;
        state.updU() = u0 + (at[k] * h) * u_dot;
      }
      realize_at(system, state, t + at[k] * h - (k == 3 ? early_s : 0.0));
      q_dot = state.getQDot();
      u_dot = state.getUDot();
      dq += weight[k] * q_dot;
      du += weight[k] * u_dot;
      if (integrals.size() > 0) dz += weight[k] * quadrature(state);
    }
    state.updQ() = q0 + h * dq;
    state.updU() = u0 + h * du;
    integrals += h * dz;
  }
  realize_at(system, state, seconds(t1_ns));
}

}  // namespace dipper::mbs
