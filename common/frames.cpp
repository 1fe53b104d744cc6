#include "common/frames.hpp"

#include <cmath>

namespace dipper {

Pose operator*(const Pose& X_AB, const Pose& X_BC) {
  return {(X_AB.R * X_BC.R).normalized(), X_AB.p + X_AB.R * X_BC.p};
}

Vector3d operator*(const Pose& X_AB, const Vector3d& p_BQ) { return X_AB.p + X_AB.R * p_BQ; }

Pose inverse(const Pose& X_AB) {
  const Quaterniond R_BA = X_AB.R.conjugate();
  return {R_BA, -(R_BA * X_AB.p)};
}

Wrench shift(const Wrench& F_P_W, const Vector3d& p_PQ_W) {
  return {F_P_W.torque - p_PQ_W.cross(F_P_W.force), F_P_W.force};
}

Wrench operator+(const Wrench& a, const Wrench& b) {
  return {a.torque + b.torque, a.force + b.force};
}

Wrench operator*(double s, const Wrench& F) { return {s * F.torque, s * F.force}; }

double power(const Wrench& F_Bo_W, const Twist& V_WB_W) {
  return F_Bo_W.torque.dot(V_WB_W.w) + F_Bo_W.force.dot(V_WB_W.v);
}

Vector3d rotation_vector(const Quaterniond& R) {
  // Near the identity Eigen's AngleAxis loses the axis; 2 vec(q) sign(w) is exact there.
  const double n = R.vec().norm();
  const double sign = R.w() < 0 ? -1.0 : 1.0;
  if (n < 1e-9) return 2.0 * sign * R.vec();
  return 2.0 * std::atan2(n, sign * R.w()) * sign / n * R.vec();
}

Quaterniond from_rotation_vector(const Vector3d& r) {
  const double angle = r.norm();
  if (angle < 1e-9) {
    return Quaterniond(1.0, 0.5 * r.x(), 0.5 * r.y(), 0.5 * r.z()).normalized();
  }
  return Quaterniond(Eigen::AngleAxisd(angle, r / angle));
}

Twist twist_between(const Pose& X0, const Pose& X1, double dt) {
  return {rotation_vector(X1.R * X0.R.conjugate()) / dt, (X1.p - X0.p) / dt};
}

PoseDistance distance(const Pose& a, const Pose& b) {
  return {(a.p - b.p).norm(), rotation_vector(a.R * b.R.conjugate()).norm()};
}

bool is_finite(const Pose& X) { return X.R.coeffs().allFinite() && X.p.allFinite(); }
bool is_finite(const Twist& V) { return V.w.allFinite() && V.v.allFinite(); }
bool is_finite(const Wrench& F) { return F.torque.allFinite() && F.force.allFinite(); }

}  // namespace dipper
