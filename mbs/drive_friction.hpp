// Friction between the drives and the dipper: of the crowd's slide and of the hoist's sheaves.
// Prescribed drives move as before; their forces change.
#pragma once

#include "machine/machine_data.hpp"

namespace dipper::mbs {

/// Coulomb friction, smoothed to v / kStandstill below that speed so that it has one value at rest,
/// s(v) = tanh(v / kStandstill):
///   crowd: -crowd_friction s(v), v the crowd's speed,
///   hoist: -hoist_loss T s(v),   v the ropes' speed over the sheaves, T both tensions together.
/// A winch that hauls in at speed then feels (1 + hoist_loss) times the ropes' tension, one that
/// pays out (1 - hoist_loss) times (capstan loss of a sheave in its bearings).
struct DriveFriction {
  static constexpr double kStandstill = 0.02;  ///< m/s

  machine::MachineData::Losses losses;
  double crowd(double speed) const;                  ///< N
  double hoist(double tension, double speed) const;  ///< N
};

}  // namespace dipper::mbs
