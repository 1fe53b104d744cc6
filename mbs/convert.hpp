// Between the core's types (Eigen) and Simbody's.
#pragma once

#include <Simbody.h>

#include "common/frames.hpp"

namespace dipper::mbs {

inline SimTK::Vec3 vec(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }
inline Vector3d vec(const SimTK::Vec3& v) { return {v[0], v[1], v[2]}; }

inline SimTK::Transform transform(const Pose& X) {
  return {SimTK::Rotation(SimTK::Quaternion(X.R.w(), X.R.x(), X.R.y(), X.R.z())), vec(X.p)};
}
inline Pose pose(const SimTK::Transform& X) {
  const SimTK::Quaternion q = X.R().convertRotationToQuaternion();
  return {Quaterniond(q[0], q[1], q[2], q[3]), vec(X.p())};
}

}  // namespace dipper::mbs
