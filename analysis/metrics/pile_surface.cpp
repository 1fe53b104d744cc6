#include "analysis/metrics/pile_surface.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace dipper::analysis::metrics {
namespace {

using Visit = std::function<void(const Vector3d&, double)>;
constexpr std::size_t kMany = 300'000;
constexpr double kMostColumns = 4e6;

void for_each_sphere(const io::DumpFrame& frame, const Visit& visit) {
  io::DumpReader::read(frame, {"x", "y", "z", "radius"}, [&](const io::ParticleChunk& c) {
    for (std::size_t i = 0; i < c.rows; ++i)
      visit({c.columns[0][i], c.columns[1][i], c.columns[2][i]}, c.columns[3][i]);
  });
}

/// The highest top in each column of a coarse grid, to leave out rock deep below.
class ColumnTops {
 public:
  ColumnTops(const Footprint& f, double cell)
      : min_(f.min), cell_(std::max(cell, std::sqrt((f.max - f.min).prod() / kMostColumns))) {
    n_ = ((f.max - f.min) / cell_).array().ceil().cast<int>() + 1;
    top_.assign(static_cast<std::size_t>(n_.x()) * static_cast<std::size_t>(n_.y()), -1e300);
  }
  double& of(const Vector3d& p) {
    const Eigen::Vector2i i = ((p.head<2>() - min_) / cell_).cast<int>();
    return top_[static_cast<std::size_t>(i.y()) * static_cast<std::size_t>(n_.x()) +
                static_cast<std::size_t>(i.x())];
  }

 private:
  Eigen::Vector2d min_;
  Eigen::Vector2i n_;
  double cell_;
  std::vector<double> top_;
};

}  // namespace

std::vector<Sphere> balls_in(const io::DumpFrame& frame, const Box& region, const Pose& X_WB) {
  std::vector<Sphere> balls;
  const Pose X_BW = inverse(X_WB);
  for_each_sphere(frame, [&](const Vector3d& p, double r) {
    const Vector3d p_B = X_BW * p;
    if (region.holds(p_B)) balls.push_back({p_B, r});
  });
  return balls;
}

double lowest_m(const io::DumpFrame& frame, const Footprint& footprint) {
  double lowest = INFINITY;
  for_each_sphere(frame, [&](const Vector3d& p, double r) {
    if (footprint.holds(p)) lowest = std::min(lowest, p.z() - r);
  });
  return std::isfinite(lowest) ? lowest : 0;
}

double height_at(const rock::SurfaceProfile& profile, double x) {
  const auto& xs = profile.x_m;
  const auto after = std::lower_bound(xs.begin(), xs.end(), x);
  const auto i = static_cast<std::size_t>(after - xs.begin());
  if (i == 0) return profile.z_m.front();
  if (i == xs.size()) return profile.z_m.back();
  const double share = (x - xs[i - 1]) / (xs[i] - xs[i - 1]);
  return (1 - share) * profile.z_m[i - 1] + share * profile.z_m[i];
}

PileSurface pile_surface(const io::DumpFrame& frame, const rock::LoadRegions& regions,
                         const Pose& X_WB, const Footprint& footprint, double floor_m) {
  const auto pile = [&](const Visit& visit) {
    for_each_sphere(frame, [&](const Vector3d& p, double r) {
      if (footprint.holds(p) && rock::location_of(regions, X_WB, p) == rock::Location::elsewhere)
        visit(p, r);
    });
  };
  double largest = 0;
  if (frame.particles > kMany)
    pile([&](const Vector3d&, double r) { largest = std::max(largest, r); });
  std::vector<Sphere> balls;
  if (largest > 0) {
    ColumnTops tops(footprint, 2 * largest);
    pile([&](const Vector3d& p, double r) { tops.of(p) = std::max(tops.of(p), p.z() + r); });
    pile([&](const Vector3d& p, double r) {
      if (p.z() + r > tops.of(p) - 6 * largest) balls.push_back({p, r});
    });
  } else {
    pile([&](const Vector3d& p, double r) { balls.push_back({p, r}); });
  }
  PileSurface s;
  if (balls.empty()) return s;
  rock::SurfaceOptions options;
  options.floor_m = floor_m;
  double grain = 0;
  for (const Sphere& b : balls) grain = std::max(grain, 2 * b.radius_m);
  s.profile = rock::surface_profile(balls, options);
  try {
    rock::PileAngleOptions flank;
    flank.floor_m = floor_m;
    s.angle = rock::pile_angle(s.profile, grain, flank);
  } catch (const std::invalid_argument&) {  // flat, or fewer bins than a line needs
  }
  return s;
}

}  // namespace dipper::analysis::metrics
