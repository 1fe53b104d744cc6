// The force law of a rope, which pulls and never pushes.
#pragma once

namespace dipper::mbs {

/// The rope's unstretched length and its rate: a winch, or a constant.
struct FreeLength {
  double length;  ///< m
  double rate;    ///< m/s
};

/// The rope at one instant.
struct RopeState {
  double stretch;         ///< m, path length less free length; negative when slack
  double stretch_rate;    ///< m/s
  double tension;         ///< N, never negative
  double elastic_energy;  ///< J
  double dissipation;     ///< W, never negative
  double winch_pull;      ///< N, of the rope on its winch, against the free length
  double winch_power;     ///< W the winch puts in by changing the free length
};

/// With L the free length, l the path, s = l - L and k = EA / (f L), f the elastic fraction:
///   elastic tension T_e = k max(s, 0), energy V = k max(s, 0)^2 / 2,
///   T = max(0, T_e + c ds/dt) where s > 0, and 0 where s <= 0.
/// L is unstretched rope, so letting it out also softens it; dV/dt at rest ends gives the winch
///   P = -T dL/dt - s T_e / (2 L) dL/dt, and the dissipation is (T - T_e) ds/dt >= 0.
struct RopeLaw {
  double axial_stiffness = 0;   ///< EA, N
  double elastic_fraction = 1;  ///< of the free length that stretches; the rest is rigid
  double damping = 0;           ///< N s/m on the rate of stretch, while taut

  /// \param path, path_rate  m, m/s: length from end to end, and its rate
  RopeState at(double path, double path_rate, const FreeLength& free) const;
};

}  // namespace dipper::mbs
