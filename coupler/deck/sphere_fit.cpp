#include "coupler/deck/sphere_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "coupler/mesh/mesh_check.hpp"
#include "coupler/mesh/signed_distance.hpp"

namespace dipper {
namespace {

using Eigen::Vector3d;

/// Of the cells of width h that begin at lo, those that lie below hi.
std::vector<double> midpoints(double lo, double hi, double h) {
  std::vector<double> out(static_cast<std::size_t>(std::max(0.0, std::ceil((hi - lo) / h - 0.5))));
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = lo + (static_cast<double>(i) + 0.5) * h;
  return out;
}

/// Midpoints of cubic cells, and how far inside the solid each lies.
struct Grid {
  double cell = 0;
  std::vector<Vector3d> points;
  std::vector<double> depth;
};

Grid make_grid(const TriangleMesh& mesh, int cells, double margin) {
  BoundingBox box;
  for (const Vector3d& v : mesh.vertices) box.add(v, margin);
  Grid g;
  g.cell = (box.max - box.min).maxCoeff() / cells;
  for (const double x : midpoints(box.min.x(), box.max.x(), g.cell))
    for (const double y : midpoints(box.min.y(), box.max.y(), g.cell))
      for (const double z : midpoints(box.min.z(), box.max.z(), g.cell)) {
        g.points.emplace_back(x, y, z);
        g.depth.push_back(signed_distance(mesh, g.points.back()));
      }
  return g;
}

bool covered(const std::vector<Sphere>& spheres, const Vector3d& p) {
  return std::any_of(spheres.begin(), spheres.end(), [&](const Sphere& s) {
    return (p - s.centre_m).squaredNorm() < s.radius_m * s.radius_m;
  });
}

/// Cells in exactly one of solid and union: what the fit makes small.
int mismatch(const Grid& g, const std::vector<Sphere>& spheres) {
  int n = 0;
  for (std::size_t i = 0; i < g.points.size(); ++i)
    n += covered(spheres, g.points[i]) != (g.depth[i] > 0);
  return n;
}

std::vector<Sphere> greedy(const Grid& g, int count, double r_min) {
  constexpr std::array<double, 4> kSwell = {1.0, 1.1, 1.25, 1.4};  // beyond the inscribed sphere
  std::vector<char> taken(g.points.size(), 0);
  std::vector<Sphere> spheres;
  while (static_cast<int>(spheres.size()) < count) {
    Sphere best;
    int best_gain = std::numeric_limits<int>::min();
    for (std::size_t c = 0; c < g.points.size(); c += 3) {
      if (g.depth[c] <= 0) continue;
      for (const double swell : kSwell) {
        const double r = std::max(swell * g.depth[c], r_min);
        int gain = 0;
        for (std::size_t i = 0; i < g.points.size(); ++i)
          if (taken[i] == 0 && (g.points[i] - g.points[c]).squaredNorm() < r * r)
            gain += g.depth[i] > 0 ? 1 : -1;
        if (gain > best_gain) {
          best_gain = gain;
          best = {g.points[c], r};
        }
      }
    }
    spheres.push_back(best);
    for (std::size_t i = 0; i < g.points.size(); ++i)
      if (covered({best}, g.points[i])) taken[i] = 1;
  }
  return spheres;
}

void climb(const Grid& g, double diameter, double r_min, std::vector<Sphere>& spheres) {
  constexpr int kTries = 4000;
  std::mt19937 random(1);
  const auto symmetric = [&] {
    return 2.0 * static_cast<double>(random()) / std::mt19937::max() - 1.0;
  };
  int best = mismatch(g, spheres);
  for (int k = 0; k < kTries; ++k) {
    const double step = 0.12 * diameter * (1.0 - static_cast<double>(k) / kTries);
    std::vector<Sphere> trial = spheres;
    Sphere& s = trial[static_cast<std::size_t>(k) % trial.size()];
    s.centre_m += step * Vector3d(symmetric(), symmetric(), symmetric());
    s.radius_m = std::max(r_min, s.radius_m + 0.5 * step * symmetric());
    const int now = mismatch(g, trial);
    if (now <= best) {
      best = now;
      spheres = std::move(trial);
    }
  }
}

/// One offset of all radii gives the union the solid's volume.
void match_volume(double volume, double diameter, std::vector<Sphere>& spheres) {
  double lo = -0.1 * diameter, hi = 0.1 * diameter;
  const auto swollen = [&](double by) {
    std::vector<Sphere> out = spheres;
    for (Sphere& s : out) s.radius_m += by;
    return out;
  };
  for (int k = 0; k < 20; ++k) {
    const double mid = (lo + hi) / 2;
    (union_volume(swollen(mid)) < volume ? lo : hi) = mid;
  }
  spheres = swollen((lo + hi) / 2);
}

}  // namespace

std::vector<Sphere> fit_spheres(const TriangleMesh& mesh, int count) {
  if (mesh.triangles.empty()) throw std::invalid_argument("the mesh has no facets");
  if (const auto faults = check_mesh(mesh); !faults.empty())
    throw std::invalid_argument("not a closed surface that faces outwards: " + faults[0].message);
  if (count < 1) throw std::invalid_argument("at least one sphere is needed");
  const double solid = volume(mesh);
  const double diameter = std::cbrt(6 * solid / M_PI);
  const double r_min = 0.2 * diameter;
  const Grid coarse = make_grid(mesh, 24, 0.05 * diameter);
  std::vector<Sphere> spheres = greedy(coarse, count, r_min);
  climb(make_grid(mesh, 36, 0.1 * diameter), diameter, r_min, spheres);
  match_volume(solid, diameter, spheres);
  return spheres;
}

double union_volume(const std::vector<Sphere>& spheres, int cells) {
  BoundingBox box;
  for (const Sphere& s : spheres) box.add(s.centre_m, s.radius_m);
  const double h = (box.max - box.min).maxCoeff() / cells;
  // Along each grid line (x, y) the spheres cover exact intervals in z.
  double volume = 0;
  std::vector<std::pair<double, double>> spans;
  const std::vector<double> ys = midpoints(box.min.y(), box.max.y(), h);
  for (const double x : midpoints(box.min.x(), box.max.x(), h))
    for (const double y : ys) {
      spans.clear();
      for (const Sphere& s : spheres) {
        const double dx = x - s.centre_m.x(), dy = y - s.centre_m.y();
        const double half2 = s.radius_m * s.radius_m - dx * dx - dy * dy;
        if (half2 <= 0) continue;
        spans.emplace_back(s.centre_m.z() - std::sqrt(half2), s.centre_m.z() + std::sqrt(half2));
      }
      std::sort(spans.begin(), spans.end());
      double top = -std::numeric_limits<double>::infinity();
      for (const auto& [lo, hi] : spans) {
        volume += h * h * std::max(0.0, hi - std::max(lo, top));
        top = std::max(top, hi);
      }
    }
  return volume;
}

double symmetric_difference(const TriangleMesh& mesh, const std::vector<Sphere>& spheres) {
  const double solid = volume(mesh);
  const Grid g = make_grid(mesh, 48, 0.15 * std::cbrt(solid));
  return mismatch(g, spheres) * g.cell * g.cell * g.cell / solid;
}

}  // namespace dipper
