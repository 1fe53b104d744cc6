// The rope's law (rope_law.hpp) as a force between Simbody's bodies, over a sheave.
#pragma once

#include <Simbody.h>

#include <functional>

#include "mbs/rope_law.hpp"

namespace dipper::mbs {

/// Where a rope runs and what it is made of.
struct RopeSpec : RopeLaw {
  SimTK::MobilizedBody sheave_body;  ///< carries the sheave; its x-z plane is the sheave's
  SimTK::Vec3 sheave_center{0};      ///< m, in sheave_body
  double sheave_radius = 0;          ///< m
  SimTK::MobilizedBody body_a;       ///< end a: the rope runs clockwise over the sheave from here
  SimTK::Vec3 station_a{0};          ///< m, in body_a
  SimTK::MobilizedBody body_b;       ///< end b
  SimTK::Vec3 station_b{0};          ///< m, in body_b
};

/// The force of a rope on a frictionless, massless sheave (a sheave's inertia is a body of the
/// model). Both ends and the sheave must lie in one plane, parallel to the sheave body's x-z.
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

  RopeSpec spec_;
  std::function<FreeLength(const SimTK::State&)> free_length_;
};

}  // namespace dipper::mbs
