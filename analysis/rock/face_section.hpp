// The face as the shovel has it before it: the surface along the boom.
#pragma once

#include "analysis/rock/surface_profile.hpp"

namespace dipper::analysis::rock {

/// Where the boom points, and what part of the face counts.
struct BoomPlane {
  double base_x_m = 0, base_y_m = 0;  ///< of the swing axis, in W
  double heading_rad = 0;
  double half_width_m = 2;  ///< to either side: half the dipper's
  double nearest_m = 0;     ///< from the swing axis: what is nearer is no face
};

/// The surface of the rock (spheres in W) within the plane's width, in steps of 0.1 m: x out from
/// the swing axis, z over the ground, from `nearest_m` on. Throws std::invalid_argument when there
/// is no rock there.
SurfaceProfile face_section(const std::vector<Sphere>& rock, const BoomPlane& plane);

}  // namespace dipper::analysis::rock
