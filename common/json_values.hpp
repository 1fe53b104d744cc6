// Vectors, rotations, poses and wrenches as JSON: lists of numbers, in SI. Reading throws
// nlohmann::json::exception when a list is not of this length or holds no numbers.
#pragma once

#include <array>
#include <nlohmann/json.hpp>

#include "common/frames.hpp"

namespace dipper {

/// [x, y, z]
inline nlohmann::json json_of(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

/// [w, x, y, z]
inline nlohmann::json json_of(const Quaterniond& R) { return {R.w(), R.x(), R.y(), R.z()}; }

/// [px, py, pz, qw, qx, qy, qz]
inline nlohmann::json json_of(const Pose& X) {
  return {X.p.x(), X.p.y(), X.p.z(), X.R.w(), X.R.x(), X.R.y(), X.R.z()};
}

/// [tx, ty, tz, fx, fy, fz]: torque first.
inline nlohmann::json json_of(const Wrench& F) {
  return {F.torque.x(), F.torque.y(), F.torque.z(), F.force.x(), F.force.y(), F.force.z()};
}

/// [wx, wy, wz, vx, vy, vz]: angular velocity first.
inline nlohmann::json json_of(const Twist& V) {
  return {V.w.x(), V.w.y(), V.w.z(), V.v.x(), V.v.y(), V.v.z()};
}

/// Exactly N numbers.
template <std::size_t N>
std::array<double, N> numbers_from(const nlohmann::json& j) {
  if (!j.is_array() || j.size() != N)
    throw nlohmann::json::other_error::create(
        501, "must be a list of " + std::to_string(N) + " numbers", &j);
  return j.get<std::array<double, N>>();
}

inline Vector3d vector_from(const nlohmann::json& j) {
  const auto v = numbers_from<3>(j);
  return {v[0], v[1], v[2]};
}

inline Quaterniond quaternion_from(const nlohmann::json& j) {
  const auto q = numbers_from<4>(j);
  return {q[0], q[1], q[2], q[3]};
}

inline Pose pose_from(const nlohmann::json& j) {
  const auto v = numbers_from<7>(j);
  return {Quaterniond(v[3], v[4], v[5], v[6]), Vector3d(v[0], v[1], v[2])};
}

inline Wrench wrench_from(const nlohmann::json& j) {
  const auto v = numbers_from<6>(j);
  return {Vector3d(v[0], v[1], v[2]), Vector3d(v[3], v[4], v[5])};
}

inline Twist twist_from(const nlohmann::json& j) {
  const auto v = numbers_from<6>(j);
  return {Vector3d(v[0], v[1], v[2]), Vector3d(v[3], v[4], v[5])};
}

}  // namespace dipper
