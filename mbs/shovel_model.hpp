// The Simbody bodies, joints and forces of the shovel (Svanberg et al. 2021, Table 3).
#pragma once

#include <Simbody.h>

#include "common/frames.hpp"
#include "machine/machine_data.hpp"
#include "mbs/drive_friction.hpp"
#include "mbs/limited_drives.hpp"
#include "mbs/prescribed.hpp"
#include "mbs/rope.hpp"

namespace dipper::mbs {

/// One object, built once, not copied: Simbody's handles point into each other.
///
///   crawlers (ground) - swing, hinge about z, driven - house
///   house - boom top, hinge about y, turned by the rigid upper rope - sheaves
///   house - saddle, hinge about -y, free - saddle block
///   saddle block - crowd, slider along x, driven - handle
///   handle - weld - dipper (frame B)
///   dipper - hinge about y, prescribed - door (frame D)
///   two ropes from the house over the sheaves to the dipper's bail
///
/// What is driven, and the sheaves with the hoist, is prescribed, or moved by motors with limits.
struct ShovelModel {
  /// \param sent where the drives are sent at a time
  ShovelModel(const machine::MachineData& machine, const Sent& sent, machine::DriveMode mode,
              const Pose& X_W0, double rake);
  ShovelModel(const ShovelModel&) = delete;
  ShovelModel& operator=(const ShovelModel&) = delete;

  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter;
  SimTK::GeneralForceSubsystem forces;
  SimTK::MobilizedBody house, sheaves, saddle, handle, dipper, door;
  SimTK::Force::DiscreteForces rock;        ///< the wrenches on dipper and door
  const Rope* rope_left = nullptr;          ///< owned by `forces`
  const Rope* rope_right = nullptr;         ///< owned by `forces`
  const DriveFriction* friction = nullptr;  ///< owned by `forces`
  LimitedDrives* limited = nullptr;         ///< owned by `forces`; none: prescribed
  SimTK::State initial;                     ///< realized to Model
};

}  // namespace dipper::mbs
