#include "analysis/rock/load.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace dipper::analysis::rock {
namespace {

constexpr double kMostLoadColumns = 4e6;  // 32 MB: only a mesh in millimetres needs more

/// The part of the line origin + s * up that is in the region: s from `low` to `high`; none: false.
bool clip(const Eigen::Vector3d& origin, const Eigen::Vector3d& up, const Box& region, double& low,
          double& high) {
  low = -std::numeric_limits<double>::infinity();
  high = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    if (std::abs(up[k]) < 1e-12) {
      if (origin[k] < region.min_m[k] || origin[k] > region.max_m[k]) return false;
      continue;
    }
    double a = (region.min_m[k] - origin[k]) / up[k], b = (region.max_m[k] - origin[k]) / up[k];
    if (a > b) std::swap(a, b);
    low = std::max(low, a);
    high = std::min(high, b);
  }
  return low < high;
}

}  // namespace

double load_volume(const std::vector<Sphere>& balls, const Eigen::Vector3d& up, const Box& region,
                   double cell_m) {
  const Eigen::Vector3d u = up.unitOrthogonal(), v = up.cross(u);
  double u0 = std::numeric_limits<double>::infinity(), v0 = u0, u1 = -u0, v1 = -u0;
  for (int k = 0; k < Box::kCorners; ++k) {
    const Eigen::Vector3d p = region.corner(k);
    u0 = std::min(u0, u.dot(p));
    u1 = std::max(u1, u.dot(p));
    v0 = std::min(v0, v.dot(p));
    v1 = std::max(v1, v.dot(p));
  }
  cell_m = std::max(cell_m, std::sqrt((u1 - u0) * (v1 - v0) / kMostLoadColumns));
  const auto nu = static_cast<int>(std::ceil((u1 - u0) / cell_m));
  const auto nv = static_cast<int>(std::ceil((v1 - v0) / cell_m));
  constexpr double kNone = -std::numeric_limits<double>::infinity();
  std::vector<double> top(static_cast<std::size_t>(nu) * static_cast<std::size_t>(nv), kNone);
  const auto cell = [&](int i, int j) -> double& {
    return top[static_cast<std::size_t>(j) * static_cast<std::size_t>(nu) +
               static_cast<std::size_t>(i)];
  };
  for (const Sphere& b : balls) {
    const double bu = (u.dot(b.centre_m) - u0) / cell_m - 0.5;
    const double bv = (v.dot(b.centre_m) - v0) / cell_m - 0.5;
    const double r = b.radius_m / cell_m, w = up.dot(b.centre_m);
    const int i1 = std::min(nu - 1, static_cast<int>(std::floor(bu + r)));
    const int j1 = std::min(nv - 1, static_cast<int>(std::floor(bv + r)));
    for (int i = std::max(0, static_cast<int>(std::ceil(bu - r))); i <= i1; ++i) {
      for (int j = std::max(0, static_cast<int>(std::ceil(bv - r))); j <= j1; ++j) {
        const double rest = r * r - (i - bu) * (i - bu) - (j - bv) * (j - bv);
        if (rest >= 0) cell(i, j) = std::max(cell(i, j), w + cell_m * std::sqrt(rest));
      }
    }
  }
  double volume = 0;
  for (int i = 0; i < nu; ++i) {
    for (int j = 0; j < nv; ++j) {
      if (cell(i, j) == kNone) continue;
      const Eigen::Vector3d origin = (u0 + cell_m * (i + 0.5)) * u + (v0 + cell_m * (j + 0.5)) * v;
      double low = 0, high = 0;
      if (!clip(origin, up, region, low, high)) continue;
      volume += std::max(0.0, std::min(high, cell(i, j)) - low) * cell_m * cell_m;
    }
  }
  return volume;
}

}  // namespace dipper::analysis::rock
