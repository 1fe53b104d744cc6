// A hoist rope: an elastic line over a sheave that pulls and never pushes.
#pragma once

#include <Simbody.h>

#include <functional>

namespace dipper::mbs {

/// Where a rope runs and what it is made of.
struct RopeSpec {
  SimTK::MobilizedBody sheave_body;  ///< carries the sheave; its x-z plane is the sheave's
  SimTK::Vec3 sheave_center{0};      ///< m, in sheave_body
  double sheave_radius = 0;          ///< m
  SimTK::MobilizedBody body_a;       ///< end a: the rope runs clockwise over the sheave from here
  SimTK::Vec3 station_a{0};          ///< m, in body_a
  SimTK::MobilizedBody body_b;       ///< end b
  SimTK::Vec3 station_b{0};          ///< m, in body_b
  double axial_stiffness = 0;        ///< EA, N
  double elastic_fraction = 1;       ///< of the free length that stretches; the rest is rigid
  double damping = 0;                ///< N s/m on the rate of stretch, while taut
  /// A drum that the rope turns by its pull, one unit of its coordinate a radius of rope; none
  /// (radius 0) where the drum's motion is prescribed.
  SimTK::MobilizedBody drum;
  double drum_radius = 0;  ///< m
};

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

/// The force of a rope on a frictionless, massless sheave (a sheave's inertia is a body of the
/// model). Both ends and the sheave must lie in one plane, parallel to the sheave body's x-z.
///
/// With L the free length, l the path, s = l - L and k = EA / (f L), f the elastic fraction:
///   elastic tension T_e = k max(s, 0), energy V = k max(s, 0)^2 / 2,
///   T = max(0, T_e + c ds/dt) where s > 0, and 0 where s <= 0.
/// L is unstretched rope, so letting it out also softens it; dV/dt at rest ends gives the winch
///   P = -T dL/dt - s T_e / (2 L) dL/dt, and the dissipation is (T - T_e) ds/dt >= 0.
class Rope : public SimTK::Force::Custom::Implementation {
 public:
  /// \param free_length of time, and of joints' coordinates and speeds
  Rope(RopeSpec spec, std::function<FreeLength(const SimTK::State&)> free_length);

  /// Stage: Velocity.
  RopeState evaluate(const SimTK::State& state) const;

  void calcForce(const SimTK::State& state, SimTK::Vector_<SimTK::SpatialVec>& body_forces,
                 SimTK::Vector_<SimTK::Vec3>& particle_forces,
                 SimTK::Vector& mobility_forces) const override;
  double calcPotentialEnergy(const SimTK::State& state) const override;

 private:
  struct End;
  struct Path;
  Path path(const SimTK::State& state) const;
  RopeState evaluate(const SimTK::State& state, const Path& path) const;
  double stiffness(double free_length) const;

  RopeSpec spec_;
  std::function<FreeLength(const SimTK::State&)> free_length_;
};

}  // namespace dipper::mbs
