// The dipper's position with rigid ropes: for checks before a run.
#pragma once

#include <string>
#include <vector>

#include "common/frames.hpp"
#include "machine/machine_data.hpp"
#include "machine/motion.hpp"

namespace dipper::machine {

/// The shovel's bodies at one instant.
struct ShovelPose {
  double saddle;  ///< rad, the handle's direction above the horizontal
  Pose X_WB;      ///< dipper
  Pose X_WD;      ///< door
};

/// The shovel with rigid ropes that never go slack.
///
/// At the saddle angle the path from the drum over the sheave to the bail is as long as the rope
/// paid out; the rest is a chain of fixed and prescribed transforms:
/// X_WB = X_W0 Rz(swing) X_HS Ry(-saddle) Tx(reach + crowd) X_EB(rake).
class ShovelKinematics {
 public:
  /// \param X_W0 pose of the crawlers' ring (H's at swing 0) in W
  /// \param rake angle between the handle's centre line and the dipper's floor, rad
  ShovelKinematics(const MachineData& machine, const Pose& X_W0, double rake);

  /// Rope length from drum to bail [m] at a saddle angle [rad] and crowd [m].
  double rope_path(double saddle, double crowd) const;

  /// The saddle angle [rad] at which the rope just holds the bail. Throws std::domain_error, with
  /// the reachable hoist range, if there is none between the saddle's limits.
  double saddle_angle(double hoist, double crowd) const;

  /// Hoist and crowd that put the middle of the tooth tips at a point in the plane of the boom (x
  /// out from the swing axis, z up from the crawlers' ground) with the ropes just taut; swing and
  /// door are 0. Throws std::domain_error for a point nearer to the saddle than the dipper reaches.
  Drives teeth_at(const Eigen::Vector2d& tip) const;

  /// The inverse: the tooth tips' point for hoist and crowd; swing and door have no effect. Throws
  /// as saddle_angle does.
  Eigen::Vector2d teeth(const Drives& drives) const;

  /// The dipper's heel, the rear edge of its floor, while the tooth tips are at that point, in the
  /// plane of the boom, as they are. Throws as teeth_at does.
  Eigen::Vector2d heel(const Eigen::Vector2d& tip) const;

  /// From the saddle to the tooth tips at a crowd [m].
  double teeth_reach(double crowd) const;

  /// Throws as saddle_angle does.
  ShovelPose pose(const Drives& drives) const;

  /// The same with the saddle angle given.
  ShovelPose pose(const Drives& drives, double saddle) const;

  /// Where the motion exceeds the machine's limits: one message per limit with the time, the worst
  /// value and the limit; empty when it does not. Also reports the dipper's outline below the
  /// ground (z = 0 of X_W0).
  std::vector<std::string> check(const Motion& motion) const;

 private:
  /// Crowd [m] and saddle angle [rad] with the tooth tips at a point, as teeth_at.
  struct Arm {
    double crowd, saddle;
  };
  Arm arm_to(const Eigen::Vector2d& tip) const;

  /// From the handle's dipper end to the tooth tips, along and across the handle (x, z of A).
  Eigen::Vector2d end_to_teeth() const;

  MachineData machine_;
  Pose X_W0_;
  Pose X_EB_;  // E: at the handle's dipper end, axes of A
};

}  // namespace dipper::machine
