// What the shovel does at an instant: forces of drives, ropes and rock, and the accelerations.
#pragma once

#include <optional>

#include "machine/machine_data.hpp"
#include "machine/motion.hpp"
#include "mbs/drive_friction.hpp"
#include "mbs/joint_stop.hpp"
#include "mbs/limited_drives.hpp"
#include "mbs/rope_law.hpp"
#include "mbs/segmented_rope.hpp"
#include "mbs/shovel_tree.hpp"

namespace dipper::mbs {

/// The shovel at an instant.
struct Instant {
  ShovelTree::Placement at;
  Joints acceleration;
  Joints force;       ///< N m and N: all but the reactions; M u' = force + reaction
  Joints applied;     ///< N m and N: motors with limits, friction, damping, the ropes on their drum
  Joints reaction;    ///< of the prescribed joints, 0 of free ones
  RopeState rope;     ///< each of the two; of a segmented one, at the sheave
  Vector3d pull;      ///< N, in H, of both together on the bail
  double rock_power;  ///< W
  double potential, kinetic;  ///< J
  std::optional<DriveEfforts> motors;
  Eigen::VectorXd rope_rates;  ///< of a segmented rope's nodes
};

/// What the drives do, positive where it puts energy into the machine.
struct DriveReport {
  double hoist_force, crowd_force, swing_torque, door_torque;  ///< N, N m
  double hoist_power, crowd_power, swing_power, door_power;    ///< W
  double dissipated_power;                                     ///< W
};

/// Hoist, crowd and swing are prescribed, or moved by motors with limits; the door is prescribed.
///
/// Both ropes run in planes parallel to the boom's, mirrored, so that one is computed and counts
/// twice; their forces on the house have no moment about the swing axis.
class ShovelDynamics {
 public:
  ShovelDynamics(const machine::MachineData& machine, machine::DriveMode mode, const Pose& X_W0,
                 double rake);

  /// Puts prescribed coordinates and speeds where they are sent.
  void prescribe(const machine::DriveState& sent, Joints& q, Joints& u) const;

  /// \param rope  of one side: nothing, or the nodes of a segmented one
  /// \param held  motors with limits stand as if they were prescribed
  /// Throws std::domain_error where the ropes have no way.
  Instant at(const Joints& q, const Joints& u, const Eigen::VectorXd& rope,
             const machine::DriveState& sent, const Wrenches& rock, bool held = false) const;

  /// \param reaction  of the prescribed joints
  DriveReport report(const Instant& now, const Joints& reaction) const;

  /// Where drives and door are; no accelerations.
  machine::DriveState where(const Joints& q, const Joints& u) const;
  Joints joints(const machine::Drives& drives) const;

  /// The motors hold the machine as it stands there. Nothing where they are prescribed.
  void hold(const Instant& at_rest);

  /// The nodes of a taut rope at rest; nothing of an elastic one.
  Eigen::VectorXd settled_rope(const Joints& q) const;
  /// What the ropes can be stepped by at most, s.
  double longest_step() const;

  bool limited() const { return motors_.has_value(); }
  double drum_inertia() const;  ///< kg m^2 that turns with the sheaves
  const ShovelTree& tree() const { return tree_; }

 private:
  FreeLength free_length(const machine::DriveState& are) const;

  machine::MachineData machine_;
  machine::DriveMode mode_;
  ShovelTree tree_;
  RopeLaw law_;
  std::optional<SegmentedRope> segments_;  ///< none: elastic ropes
  DriveFriction friction_;
  JointStop crowd_stop_;  ///< for a crowd that is free to move
  std::optional<LimitedDrives> motors_;
};

}  // namespace dipper::mbs
