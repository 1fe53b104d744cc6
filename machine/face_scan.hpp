// A face as a mine's scanner sees it.
#pragma once

#include <cstdint>

#include "common/height_map.hpp"

namespace dipper::machine {

struct ScanErrors {
  double height_m = 0;        ///< standard error of a height, normally distributed
  double dead_angle_rad = 0;  ///< rock is not seen where the line of sight meets it at less
};

/// What a scanner at a point sees of it. Places behind rock, or met at less than the dead angle, it
/// does not see; with one of the two, not with neither. Their heights are put in straight between
/// those seen on either side along x. The same seed gives the same errors.
HeightMap scanned(const HeightMap& face, const Vector3d& eye_W, const ScanErrors& errors,
                  std::uint64_t seed);

}  // namespace dipper::machine
