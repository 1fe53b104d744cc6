#include "analysis/rock/face_section.hpp"

#include <cmath>
#include <stdexcept>

namespace dipper::analysis::rock {

SurfaceProfile face_section(const std::vector<Sphere>& rock, const BoomPlane& plane) {
  const double c = std::cos(plane.heading_rad), s = std::sin(plane.heading_rad);
  std::vector<Sphere> near;
  for (const Sphere& ball : rock) {
    const double dx = ball.centre_m.x() - plane.base_x_m, dy = ball.centre_m.y() - plane.base_y_m;
    const Eigen::Vector3d p(c * dx + s * dy, c * dy - s * dx, ball.centre_m.z());
    if (std::abs(p.y()) < plane.half_width_m && p.x() > plane.nearest_m)
      near.push_back({p, ball.radius_m});
  }
  SurfaceOptions options;
  options.step_m = 0.1;
  options.cell_m = 0.05;
  return surface_profile(near, options);
}

}  // namespace dipper::analysis::rock
