// The volume of a dipper's load, voids included.
#pragma once

#include <vector>

#include "common/box.hpp"
#include "common/sphere.hpp"

namespace dipper::analysis::rock {

/// Volume inside the region and below the load's upper surface [m3], seen along gravity: in columns
/// of side `cell_m` (wider if there were more than 4 million) along `up`, from the region's bottom
/// to the top of the highest ball over the column's centre. Columns without a ball count as empty.
/// Balls and `up` (a unit vector) are in the region's frame.
double load_volume(const std::vector<Sphere>& balls, const Eigen::Vector3d& up, const Box& region,
                   double cell_m);

}  // namespace dipper::analysis::rock
