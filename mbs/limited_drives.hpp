// Hoist, crowd and swing as motors that follow where they are sent as far as they can.
#pragma once

#include <Simbody.h>

#include "machine/machine_data.hpp"
#include "mbs/drive_limit.hpp"
#include "mbs/operator.hpp"
#include "mbs/prescribed.hpp"

namespace dipper::mbs {

/// What one drive does: along its coordinate, N, swing N m.
struct DriveEffort {
  double wanted;
  double most;
  double force;
  double speed;
  double sent_speed;
  bool saturated() const { return wanted > most || wanted < -most; }
};

/// The forces of the three drives on the joints they move: the drum (the sheaves' joint, which the
/// rigid upper rope turns), the handle's slide, the house.
class LimitedDrives : public SimTK::Force::Custom::Implementation {
 public:
  LimitedDrives(const machine::MachineData& machine, Sent sent, SimTK::MobilizedBody drum,
                SimTK::MobilizedBody handle, SimTK::MobilizedBody house);

  /// Forces that hold the machine where it stands at the start, along hoist, crowd and swing.
  void set_trims(const machine::Drives& force);

  /// Stage: Velocity.
  DriveEffort hoist(const SimTK::State& state) const;
  DriveEffort crowd(const SimTK::State& state) const;
  DriveEffort swing(const SimTK::State& state) const;

  /// A drive that brakes is ahead of where it is sent, and sending it slower would be no help: it
  /// has none.
  Overload overload(const SimTK::State& state) const;

  /// Where the three are; the door is 0.
  machine::DriveState where(const SimTK::State& state) const;

  void calcForce(const SimTK::State& state, SimTK::Vector_<SimTK::SpatialVec>& body_forces,
                 SimTK::Vector_<SimTK::Vec3>& particle_forces,
                 SimTK::Vector& mobility_forces) const override;
  double calcPotentialEnergy(const SimTK::State&) const override { return 0; }

 private:
  DriveEffort effort(const LimitedDrive& drive, double machine::Drives::*which,
                     const SimTK::State& state) const;

  Sent sent_;
  double radius_;
  SimTK::MobilizedBody drum_, handle_, house_;
  LimitedDrive hoist_, crowd_, swing_;
};

}  // namespace dipper::mbs
