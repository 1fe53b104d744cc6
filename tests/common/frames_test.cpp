#include "common/frames.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace dipper {
namespace {

Pose some_pose() {
  Pose X;
  X.p = Vector3d(1.5, -2, 0.25);
  X.R = Eigen::AngleAxisd(0.7, Vector3d(1, 2, -0.5).normalized());
  return X;
}

TEST(Pose, InverseUndoes) {
  const Pose X = some_pose();
  const Vector3d p(0.3, 4, -1);
  EXPECT_LT((inverse(X) * (X * p) - p).norm(), 1e-15);
  const auto d = distance(X * inverse(X), Pose{});
  EXPECT_LT(d.metres, 1e-15);
  EXPECT_LT(d.radians, 1e-15);
}

TEST(Pose, CompositionActsLikeBothInTurn) {
  const Pose X_AB = some_pose();
  Pose X_BC;
  X_BC.p = Vector3d(0, 1, 0);
  X_BC.R = Eigen::AngleAxisd(-1.1, Vector3d::UnitZ());
  const Vector3d p_CQ(1, 2, 3);
  EXPECT_LT(((X_AB * X_BC) * p_CQ - X_AB * (X_BC * p_CQ)).norm(), 1e-14);
}

TEST(Wrench, ShiftMovesTheTorqueArm) {
  // A force of 10 N along y at P; seen from Q = P + (2, 0, 0), it turns clockwise about z.
  Wrench F_P;
  F_P.force = Vector3d(0, 10, 0);
  const Wrench F_Q = shift(F_P, Vector3d(2, 0, 0));
  EXPECT_EQ(F_Q.torque, Vector3d(0, 0, -20));
  EXPECT_EQ(F_Q.force, F_P.force);
}

TEST(Wrench, PowerDoesNotDependOnThePointOfReference) {
  Wrench F_P{{3, -1, 2}, {10, 20, -5}};
  Twist V_P{{0.1, -0.4, 0.2}, {1, 0, -2}};
  const Vector3d p_PQ(0.5, 1.5, -2.5);
  const Twist V_Q{V_P.w, V_P.v + V_P.w.cross(p_PQ)};
  EXPECT_NEAR(power(shift(F_P, p_PQ), V_Q), power(F_P, V_P), 1e-13);
}

TEST(RotationVector, RoundTripFromTinyToHalfTurn) {
  const Vector3d axis = Vector3d(1, -2, 0.5).normalized();
  for (const double angle : {0.0, 1e-14, 1e-10, 1e-8, 1e-3, 1.0, 3.0, M_PI - 1e-9}) {
    const Vector3d r = angle * axis;
    EXPECT_LT((rotation_vector(from_rotation_vector(r)) - r).norm(), 1e-14 + 1e-12 * angle)
        << angle;
  }
}

TEST(RotationVector, TakesTheShortWayForEitherSignOfTheQuaternion) {
  const Quaterniond R = from_rotation_vector({0, 0, 0.3});
  const Quaterniond same(-R.w(), -R.x(), -R.y(), -R.z());
  EXPECT_LT((rotation_vector(same) - Vector3d(0, 0, 0.3)).norm(), 1e-15);
}

TEST(TwistBetween, TakesOnePoseToTheOther) {
  const Pose X0 = some_pose();
  Pose X1;
  X1.p = Vector3d(1.6, -1.9, 0.2);
  X1.R = Eigen::AngleAxisd(0.9, Vector3d(1, 1, 1).normalized());
  const double H = 0.002;
  const Twist V = twist_between(X0, X1, H);
  Pose X = X0;
  for (int k = 0; k < 10; ++k) {
    X.p += V.v * H / 10;
    X.R = from_rotation_vector(V.w * H / 10) * X.R;
  }
  EXPECT_LT(distance(X, X1).metres, 1e-14);
  EXPECT_LT(distance(X, X1).radians, 1e-14);
}

TEST(IsFinite, SeesEveryComponent) {
  Wrench F;
  EXPECT_TRUE(is_finite(F));
  F.torque.y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(is_finite(F));
  Pose X;
  X.R.z() = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(is_finite(X));
}

}  // namespace
}  // namespace dipper
