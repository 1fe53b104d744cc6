// Poses, twists and wrenches, in Drake's monogram notation (docs/frames.md).
#pragma once

#include <Eigen/Geometry>

namespace dipper {

using Eigen::Quaterniond;
using Eigen::Vector3d;

/// X_AB: the pose of frame B in frame A. p in m; R is a unit quaternion.
struct Pose {
  Quaterniond R = Quaterniond::Identity();
  Vector3d p = Vector3d::Zero();
};

/// V_WB_W: angular [rad/s] and linear [m/s] velocity of B's origin, in world axes.
struct Twist {
  Vector3d w = Vector3d::Zero();
  Vector3d v = Vector3d::Zero();
};

/// F_Bo_W: torque about B's origin [N m] and force [N], in world axes, on the body.
struct Wrench {
  Vector3d torque = Vector3d::Zero();
  Vector3d force = Vector3d::Zero();
};

/// Where a body is and how it moves.
struct BodyState {
  Pose X_WB;
  Twist V_WB_W;
};

/// X_AC = X_AB * X_BC.
Pose operator*(const Pose& X_AB, const Pose& X_BC);

/// p_AQ = X_AB * p_BQ: the point Q, measured in B, seen from A.
Vector3d operator*(const Pose& X_AB, const Vector3d& p_BQ);

Pose inverse(const Pose& X_AB);

/// The same force system about Q instead of P; p_PQ_W is the vector from P to Q [m].
Wrench shift(const Wrench& F_P_W, const Vector3d& p_PQ_W);

Wrench operator+(const Wrench& a, const Wrench& b);
Wrench operator*(double s, const Wrench& F);

/// F·V: the power [W] a wrench puts into a body that moves with twist V (same point, same axes).
double power(const Wrench& F_Bo_W, const Twist& V_WB_W);

/// Axis times angle [rad] of a rotation, angle in [0, pi].
Vector3d rotation_vector(const Quaterniond& R);
Quaterniond from_rotation_vector(const Vector3d& r);

/// The constant twist (about B's origin, which moves on a line) that takes X0 to X1 in dt seconds.
Twist twist_between(const Pose& X0, const Pose& X1, double dt);

/// How far two poses are apart: origin distance [m] and rotation angle [rad].
struct PoseDistance {
  double metres;
  double radians;
};
PoseDistance distance(const Pose& a, const Pose& b);

bool is_finite(const Pose& X);
bool is_finite(const Twist& V);
bool is_finite(const Wrench& F);

}  // namespace dipper
