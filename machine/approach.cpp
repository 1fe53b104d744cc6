#include "machine/approach.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace dipper::machine {
namespace {

constexpr double kApproachStep_m = 0.1;  // of the way, and over the floor
constexpr double kHeld = 0.25;           // of the floor's width

/// Whether the floor between teeth and heel is over the rock.
bool is_clear(const Vector2d& teeth, const Vector2d& heel, const HeightMap& face,
              const Pose& X_WBoom, double half_width_m) {
  const int along = static_cast<int>(std::ceil((teeth - heel).norm() / kApproachStep_m)),
            across = static_cast<int>(std::ceil(2 * half_width_m / face.grid().cell_m));
  for (int i = 0; i <= along; ++i) {
    const Vector2d p = heel + (teeth - heel) * (static_cast<double>(i) / along);
    int held = 0;
    for (int j = 0; j <= across; ++j) {
      const double y = half_width_m * (2.0 * j / across - 1);
      const Vector3d at = X_WBoom * Vector3d(p.x(), y, 0);
      const double rock = face.height(at.x(), at.y());
      if (rock > 0 && p.y() < rock + kApproachClear_m) ++held;
    }
    if (held > kHeld * (across + 1)) return false;
  }
  return true;
}

}  // namespace

Vector2d approach_end(const TeethPath& way, const HeightMap& face, const Pose& X_WBoom,
                      double half_width_m, const ShovelKinematics& shovel) {
  const int n = static_cast<int>(std::ceil(length(way) / kApproachStep_m));
  const auto point = [&](int k) { return at_fraction(way, static_cast<double>(k) / n); };
  int last = -1;
  while (last < n &&
         is_clear(point(last + 1), shovel.heel(point(last + 1)), face, X_WBoom, half_width_m))
    ++last;
  if (last < 0) throw std::domain_error("the dipper cannot come down: there is rock in its way");
  return point(last);
}

}  // namespace dipper::machine
