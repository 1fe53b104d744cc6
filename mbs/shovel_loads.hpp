// Forces on the shovel's joints besides gravity and rock: ropes, drives, friction, stops.
#pragma once

#include <optional>

#include "machine/machine_data.hpp"
#include "machine/motion.hpp"
#include "mbs/drive_friction.hpp"
#include "mbs/joint_stop.hpp"
#include "mbs/limited_drives.hpp"
#include "mbs/rope_law.hpp"
#include "mbs/segmented_rope.hpp"
#include "mbs/shovel_joints.hpp"

namespace dipper::mbs {

/// Position of the joints and of the ropes' lower end. Vectors in H, which turns with the house.
struct ShovelPlace {
  Joints q, u;
  Vector3d bail;       ///< m, the middle between its pins
  Vector3d bail_rate;  ///< m/s, against H
  Vector3d gravity;    ///< m/s^2
};

/// The forces there.
struct ShovelLoads {
  RopeState rope;  ///< each of the two; of a segmented one, at the sheave
  Vector3d pull;   ///< N, in H, of both together on the bail
  Joints applied;  ///< N m and N: motors with limits, friction, stops, damping, the ropes on their
                   ///< drum
  double kinetic, potential;  ///< J, of ropes and stops
  std::optional<DriveEfforts> motors;
  Eigen::VectorXd rope_rates;  ///< of a segmented rope's nodes
};

/// Forces and powers of the drives, positive when they put energy into the machine.
struct DriveReport {
  double hoist_force, crowd_force, swing_torque, door_torque;  ///< N, N m
  double hoist_power, crowd_power, swing_power, door_power;    ///< W
  double dissipated_power;                                     ///< W
  double power() const { return hoist_power + crowd_power + swing_power + door_power; }
};

/// The force laws of the shovel's drives and ropes. Hoist, crowd and swing are prescribed, or moved
/// by motors with limits; the door is prescribed.
///
/// Both ropes run in planes parallel to the boom's, mirrored, so one is computed and counted
/// twice; their forces on the house have no moment about the swing axis.
class ShovelLoadLaws {
 public:
  ShovelLoadLaws(const machine::MachineData& machine, machine::DriveMode mode);

  /// \param rope  of one side: empty, or the nodes of a segmented one
  /// \param to    the drives' set points
  /// \param held  the joints are locked, and motors with limits give no force
  /// Throws std::domain_error where the ropes have no path.
  ShovelLoads at(const ShovelPlace& place, const Eigen::VectorXd& rope,
                 const machine::DriveState& to, bool held) const;

  /// \param reaction  N m and N, what it takes to move the prescribed joints; 0 of free ones
  DriveReport report(const ShovelLoads& now, const Joints& q, const Joints& u,
                     const Joints& reaction) const;

  /// Position of drives and door; no accelerations.
  machine::DriveState drives(const Joints& q, const Joints& u) const;
  Joints joints(const machine::Drives& drives) const;

  /// Makes the motors hold the machine, by the reactions of its locked joints. Does nothing when
  /// the drives are prescribed.
  void hold(const Joints& reaction);

  /// The nodes of a taut rope at rest; empty for an elastic one.
  Eigen::VectorXd settled_rope(const ShovelPlace& place) const;
  int rope_numbers() const { return segments_ ? segments_->size() : 0; }
  /// The longest step for the ropes, s.
  double longest_step() const;

  bool limited() const { return motors_.has_value(); }
  double drum_inertia() const;  ///< kg m^2 that turns with the sheaves

 private:
  FreeLength free_length(const machine::DriveState& are) const;

  machine::MachineData machine_;
  RopeLaw law_;
  std::optional<SegmentedRope> segments_;  ///< empty: elastic ropes
  DriveFriction friction_;
  JointStop crowd_stop_;  ///< for a crowd that is free to move
  std::optional<LimitedDrives> motors_;
};

}  // namespace dipper::mbs
