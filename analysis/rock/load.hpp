// The volume that a dipper's load takes, voids and all.
#pragma once

#include <vector>

#include "common/box.hpp"
#include "common/sphere.hpp"

namespace dipper::analysis::rock {

/// What lies inside the region and under the load's upper surface, seen along gravity [m3]: in
/// columns of side `cell_m` (more where those were above 4 million) along `up`, from the region's
/// bottom to the top of the highest ball over the column's middle. Columns without a ball count
/// nothing. Balls and `up` (a unit vector) are in the region's frame.
double load_volume(const std::vector<Sphere>& balls, const Eigen::Vector3d& up, const Box& region,
                   double cell_m);

}  // namespace dipper::analysis::rock
