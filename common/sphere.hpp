#pragma once

#include <Eigen/Core>

namespace dipper {

/// Of a bed, or of the union of spheres that represents a rock.
struct Sphere {
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  double radius_m = 0;
};

}  // namespace dipper
