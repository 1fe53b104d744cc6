// The surface of a bed of spheres, as a scanner above it sees it.
#pragma once

#include <vector>

#include "common/sphere.hpp"

namespace dipper::analysis::rock {

/// z(x) of the surface, x ascending in equal steps. A bin without balls has the floor's height.
struct SurfaceProfile {
  double step_m = 0;
  std::vector<double> x_m;  ///< centre of each bin
  std::vector<double> z_m;
};

struct SurfaceOptions {
  double cell_m = 0;   ///< side of the columns; 0: a quarter of the smallest radius
  double step_m = 0;   ///< width of a bin of x; 0: half the smallest radius
  double floor_m = 0;  ///< z where there is no rock
};

/// The height of a column is that of the highest ball over its centre; of a bin, the median of its
/// columns over y, so that a rock in the air or one that rolled away does not count. Seen from
/// above, a rough slope has the same height over its mean plane everywhere, so slopes are unbiased.
/// Only between the y of the outermost balls' centres. Throws std::invalid_argument when there is
/// no ball, or one without a finite centre and a radius > 0.
SurfaceProfile surface_profile(const std::vector<Sphere>& balls,
                               const SurfaceOptions& options = {});

}  // namespace dipper::analysis::rock
