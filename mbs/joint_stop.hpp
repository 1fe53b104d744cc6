// The end stop of a joint: a buffer that pushes back and never pulls.
#pragma once

namespace dipper::mbs {

/// With d the depth beyond either end: F = max(0, k d + c dd/dt) where d > 0, towards the inside.
struct JointStop {
  double low, high;  ///< m
  double stiffness;  ///< N/m
  double damping;    ///< N s/m

  double force(double x, double v) const;  ///< N, along x
  double energy(double x) const;           ///< J
  /// W, never negative.
  double dissipation(double x, double v) const;

 private:
  double depth(double x) const;  ///< m, signed: beyond the upper end is positive
};

}  // namespace dipper::mbs
