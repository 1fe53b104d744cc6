#include "machine/cut_ahead.hpp"

#include <algorithm>
#include <cmath>

namespace dipper::machine {
namespace {

constexpr double kStill_m_s = 1e-3;
constexpr double kSteepest_rad = 0.7;  // of a face: steeper is the side of the cut itself
constexpr double kOn_m = 1;            // over which its slope is taken

}  // namespace

CutAhead cut_ahead(const HeightMap& bench, const Pose& X_WB, const Vector3d& left_B,
                   const Vector3d& right_B, const Vector3d& v_W) {
  const Vector3d left = X_WB * left_B, right = X_WB * right_B;
  const Vector3d ahead = X_WB.R * Vector3d::UnitX();  // the way of the floor from heel to teeth
  const Vector3d level = Vector3d(ahead.x(), ahead.y(), 0).normalized();
  // In the next cell: this one is cut. And the surface's slope from there to a metre on.
  const double next_m = 1.5 * bench.grid().cell_m;
  const int n = static_cast<int>(std::ceil((left - right).norm() / bench.grid().cell_m));
  double over_m = 0, rise_m = 0;
  for (int i = 0; i <= n; ++i) {
    const Vector3d tip = right + (left - right) * (static_cast<double>(i) / n);
    const auto surface = [&](double on_m) {
      const Vector3d p = tip + on_m * level;
      return bench.height(p.x(), p.y());
    };
    over_m += std::max(0.0, surface(next_m) - tip.z()) / (n + 1);
    rise_m += (surface(next_m + kOn_m) - surface(next_m)) / (n + 1);
  }
  const double slope = std::clamp(std::atan2(rise_m, kOn_m), 0.0, kSteepest_rad);
  CutAhead cut;
  cut.depth_m = over_m * std::cos(slope);
  cut.meets = cut.depth_m > 0 && v_W.norm() >= kStill_m_s && v_W.dot(ahead) >= 0;
  return cut;
}

}  // namespace dipper::machine
