#include "machine/teeth_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "machine/monotone_slope.hpp"

namespace dipper::machine {
namespace {

constexpr std::size_t kPoints = 4000;  // of a path
constexpr std::size_t kLegPoints = 200;
constexpr double kPathStep_m = 0.1;     // of a face's surface
constexpr double kRise_m = 0.01;        // at a time, until the heel is clear
constexpr double kPolygonSide_m = 1.6;  // coarse: the spline smooths the unevenness of rocks

/// The same number of points, at equal steps along the line through the given ones.
TeethPath evenly(const TeethPath& points, std::size_t n) {
  std::vector<double> way(1, 0);
  for (std::size_t i = 1; i < points.size(); ++i)
    way.push_back(way.back() + (points[i] - points[i - 1]).norm());
  TeethPath out;
  std::size_t i = 1;
  for (std::size_t k = 0; k < n; ++k) {
    const double s = way.back() * static_cast<double>(k) / static_cast<double>(n - 1);
    while (i + 1 < points.size() && way[i] < s) ++i;
    const double side = way[i] - way[i - 1];
    const double share = side > 0 ? std::clamp((s - way[i - 1]) / side, 0.0, 1.0) : 0;
    out.push_back(points[i - 1] + share * (points[i] - points[i - 1]));
  }
  return out;
}

/// The surface at equal steps, each the mean over `smooth_m`.
TeethPath smoothed(const TeethPath& face, double smooth_m) {
  const int side = std::max(0, static_cast<int>(std::lround(0.5 * smooth_m / kPathStep_m)));
  TeethPath out;
  for (double x = face.front().x(); x <= face.back().x(); x += kPathStep_m) {
    double sum = 0;
    for (int k = -side; k <= side; ++k) sum += height(face, x + k * kPathStep_m);
    out.emplace_back(x, sum / (2 * side + 1));
  }
  return out;
}

/// The surface moved into the rock by a depth, square to itself.
TeethPath below(const TeethPath& surface, double depth_m) {
  TeethPath out;
  for (std::size_t i = 1; i + 1 < surface.size(); ++i) {
    const Vector2d along = (surface[i + 1] - surface[i - 1]).normalized();
    out.push_back(surface[i] + depth_m * Vector2d(along.y(), -along.x()));
  }
  std::sort(out.begin(), out.end(),
            [](const Vector2d& a, const Vector2d& b) { return a.x() < b.x(); });
  return out;
}

}  // namespace

double height(const TeethPath& face, double x) {
  if (x <= face.front().x()) return face.front().y();
  if (x >= face.back().x()) return face.back().y();
  const auto after = std::upper_bound(
      face.begin(), face.end(), x, [](double value, const Vector2d& p) { return value < p.x(); });
  const Vector2d &b = *after, &a = *(after - 1);
  return a.y() + (b.y() - a.y()) * (x - a.x()) / (b.x() - a.x());
}

TeethPath spline(const TeethPath& polygon) {
  TeethPath p(2, polygon.front());
  p.insert(p.end(), polygon.begin(), polygon.end());
  p.insert(p.end(), 2, polygon.back());
  TeethPath points;
  const double pieces = static_cast<double>(p.size() - 3) - 1e-9;
  for (std::size_t i = 0; i < kPoints; ++i) {
    const double u = pieces * static_cast<double>(i) / static_cast<double>(kPoints - 1);
    const auto k = static_cast<std::size_t>(u);
    const double t = u - std::floor(u);
    points.push_back(((1 - t) * (1 - t) * (1 - t) * p[k] +
                      (3 * t * t * t - 6 * t * t + 4) * p[k + 1] +
                      (-3 * t * t * t + 3 * t * t + 3 * t + 1) * p[k + 2] + t * t * t * p[k + 3]) /
                     6);
  }
  return evenly(points, kPoints);
}

std::vector<TeethPath> legs_through(const TeethPath& points) {
  const std::size_t n = points.size();
  std::vector<double> h(n - 1);
  TeethPath d(n - 1);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    h[i] = (points[i + 1] - points[i]).norm();
    d[i] = (points[i + 1] - points[i]) / h[i];
  }
  const auto slope = [&](std::size_t i) -> Vector2d {
    if (i == 0 || i + 1 == n) return d[i == 0 ? 0 : n - 2];
    return {monotone_slope(h[i - 1], d[i - 1].x(), h[i], d[i].x()),
            monotone_slope(h[i - 1], d[i - 1].y(), h[i], d[i].y())};
  };
  std::vector<TeethPath> legs;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const Vector2d m0 = h[i] * slope(i), m1 = h[i] * slope(i + 1), way = points[i + 1] - points[i];
    TeethPath leg;
    for (std::size_t k = 0; k < kLegPoints; ++k) {
      const double s = static_cast<double>(k) / static_cast<double>(kLegPoints - 1);
      leg.push_back(points[i] + s * (m0 + s * (3 * way - 2 * m0 - m1 + s * (m0 + m1 - 2 * way))));
    }
    legs.push_back(evenly(leg, kLegPoints));
  }
  return legs;
}

double length(const TeethPath& path) {
  double length = 0;
  for (std::size_t i = 1; i < path.size(); ++i) length += (path[i] - path[i - 1]).norm();
  return length;
}

Vector2d at_fraction(const TeethPath& path, double share) {
  const double place = std::clamp(share, 0.0, 1.0) * static_cast<double>(path.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(place), path.size() - 2);
  return path[i] + (place - static_cast<double>(i)) * (path[i + 1] - path[i]);
}

TeethPath cut_path(const TeethPath& face, const Cut& cut, const Vector2d& saddle, double reach_m,
                   const std::function<Vector2d(const Vector2d&)>& heel) {
  const TeethPath bottom = below(smoothed(face, cut.smooth_m), cut.depth_m);
  const auto floor = [&](double x) {
    return cut.start.y() + cut.floor_rise * std::max(0.0, x - cut.start.x());
  };
  TeethPath path(1, cut.begin.value_or(cut.start));
  double z = path.front().y();
  while (true) {
    const double x = path.back().x() + kPathStep_m;
    z = std::max({z, floor(x), height(bottom, x)});
    for (Vector2d h = heel({x, z}); h.y() < floor(h.x()) && z < cut.exit_z_m; h = heel({x, z}))
      z += kRise_m;
    const Vector2d next(x, z);
    if ((next - saddle).norm() > reach_m || z > cut.exit_z_m || x > bottom.back().x()) break;
    path.push_back(next);
  }
  if (path.size() < 2) throw std::invalid_argument("the face is out of the dipper's reach");
  const double rise = (cut.exit_z_m - saddle.y()) / reach_m;
  if (path.back().y() < cut.exit_z_m && std::abs(rise) < 1) {
    // Up on the circle, at the distance that is reached.
    const Vector2d arm = path.back() - saddle;
    const double from = std::atan2(arm.y(), arm.x());
    const double to = std::asin(std::clamp((cut.exit_z_m - saddle.y()) / arm.norm(), -1.0, 1.0));
    for (int k = 1; k <= 30 && to > from; ++k) {
      const double a = from + (to - from) * k / 30;
      path.push_back(saddle + arm.norm() * Vector2d(std::cos(a), std::sin(a)));
    }
  }
  const auto sides = std::max(6L, std::lround(length(path) / kPolygonSide_m));
  return evenly(path, static_cast<std::size_t>(sides) + 1);
}

}  // namespace dipper::machine
