// One step of the classic Runge-Kutta 4: the integrator of everything here.
#pragma once

namespace dipper::mbs {

/// Takes y from t over h. \param rate  dy/dt = rate(y, t), a V
///
/// The tableau: at 0, 1/2, 1/2, 1 of the step, with weights 1 2 2 1 sixths. The last stage is a
/// picosecond early: far above a double's resolution there, and far below anything the motion
/// notices, but on this side of a jump of the prescribed accelerations at the step's end.
template <typename V, typename Rate>
void runge_kutta_step(V& y, double t, double h, Rate rate) {
  constexpr double early_s = 1e-12;
  constexpr double at[4] = {0.0, 0.5, 0.5, 1.0};
  constexpr double weight[4] = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
  V slope = rate(y, t), mean = weight[0] * slope, stage = y;
  for (int k = 1; k < 4; ++k) {
    stage = y + (at[k] * h) * slope;
    slope = rate(stage, t + at[k] * h - (k == 3 ? early_s : 0.0));
    mean += weight[k] * slope;
  }
  y += h * mean;
}

}  // namespace dipper::mbs
