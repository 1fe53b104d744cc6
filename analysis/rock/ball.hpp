// A sphere of a bed, as the pure measurements of this folder take it.
#pragma once

#include <Eigen/Core>

namespace dipper::analysis::rock {

/// In W. A rock of several spheres is several balls.
struct Ball {
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  double radius_m = 0;
};

}  // namespace dipper::analysis::rock
