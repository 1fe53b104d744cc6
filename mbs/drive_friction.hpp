// What the drives lose on the way to the dipper: friction of the crowd's slide and of the hoist's
// sheaves. The drives are prescribed, so the motion stays the same and their forces change.
#pragma once

#include <Simbody.h>

#include "machine/machine_data.hpp"
#include "mbs/rope.hpp"

namespace dipper::mbs {

/// Coulomb friction, smoothed to v / kStandstill below that speed so that it has one value at rest:
///   crowd:  F = -crowd_friction s(v),           v the crowd's speed,  s(v) = tanh(v / kStandstill)
///   hoist:  M = -hoist_loss R (T_l + T_r) s(v), v the rope's speed over the sheaves
/// A winch that hauls in at speed then feels (1 + hoist_loss) times the rope's tension, one that
/// pays out (1 - hoist_loss) times (capstan loss of a sheave in its bearings).
class DriveFriction : public SimTK::Force::Custom::Implementation {
 public:
  static constexpr double kStandstill = 0.02;  ///< m/s

  /// \param sheave_radius m; the sheaves' rate times it is the rope's speed
  DriveFriction(const machine::MachineData::Losses& losses, double sheave_radius,
                SimTK::MobilizedBody handle, SimTK::MobilizedBody sheaves, const Rope* left,
                const Rope* right);

  void calcForce(const SimTK::State& state, SimTK::Vector_<SimTK::SpatialVec>& body_forces,
                 SimTK::Vector_<SimTK::Vec3>& particle_forces,
                 SimTK::Vector& mobility_forces) const override;
  double calcPotentialEnergy(const SimTK::State&) const override { return 0; }

  /// W, never negative. Stage: Velocity.
  double dissipation(const SimTK::State& state) const;

 private:
  double crowd_force(const SimTK::State& state) const;    ///< N on the handle's slide
  double sheave_torque(const SimTK::State& state) const;  ///< N m on the sheaves

  machine::MachineData::Losses losses_;
  double radius_;
  SimTK::MobilizedBody handle_, sheaves_;
  const Rope* left_;
  const Rope* right_;
};

}  // namespace dipper::mbs
