#include "coupler/deck/sphere_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "common/mesh/mesh_check.hpp"
#include "coupler/deck/solid_columns.hpp"

namespace dipper::deck {
namespace {

using Eigen::Vector3d;
using Eigen::Vector4d;
using Spheres = std::vector<Sphere>;

constexpr int kStarts = 24;
constexpr int kSteps = 400;
constexpr int kSurfacePoints = 240;  // on each sphere
constexpr double kFirstStep = 0.03;  // of the diameter

/// The parts of the line (x, y) inside the union.
void union_spans(const Spheres& spheres, double x, double y, Spans& out) {
  out.clear();
  for (const Sphere& s : spheres) {
    const double dx = x - s.centre_m.x(), dy = y - s.centre_m.y();
    const double half2 = s.radius_m * s.radius_m - dx * dx - dy * dy;
    if (half2 <= 0) continue;
    const double half = std::sqrt(half2);
    out.emplace_back(s.centre_m.z() - half, s.centre_m.z() + half);
  }
  join(out);
}

/// The quantity that the fit minimises [m3].
double mismatch(const SolidColumns& solid, const Spheres& spheres) {
  double length = 0;
  Spans spans;
  for (std::size_t k = 0; k < solid.size(); ++k) {
    union_spans(spheres, solid.x(k), solid.y(k), spans);
    length += difference(solid.spans(k), spans);
  }
  return length * solid.cell_m() * solid.cell_m();
}

/// Evenly spread unit vectors: the Fibonacci lattice.
std::vector<Vector3d> directions(int n) {
  const double golden = M_PI * (3 - std::sqrt(5.0));
  std::vector<Vector3d> out;
  for (int i = 0; i < n; ++i) {
    const double z = 1 - (2 * i + 1.0) / n, r = std::sqrt(1 - z * z);
    out.emplace_back(r * std::cos(golden * i), r * std::sin(golden * i), z);
  }
  return out;
}

/// d mismatch / d (centre, radius) of sphere i.
Vector4d gradient(const SolidColumns& solid, const Spheres& spheres, std::size_t i,
                  const std::vector<Vector3d>& normals) {
  const Sphere& s = spheres[i];
  Vector4d sum = Vector4d::Zero();
  for (const Vector3d& n : normals) {
    const Vector3d p = s.centre_m + s.radius_m * n;
    const bool covered = std::any_of(spheres.begin(), spheres.end(), [&](const Sphere& q) {
      return &q != &s && (p - q.centre_m).squaredNorm() < q.radius_m * q.radius_m;
    });
    if (covered) continue;
    const double sign = solid.inside(p) ? -1 : 1;
    sum += sign * Vector4d(n.x(), n.y(), n.z(), 1);
  }
  const double area = 4 * M_PI * s.radius_m * s.radius_m;
  return area / static_cast<double>(normals.size()) * sum;
}

/// Points inside the solid, a cell apart.
std::vector<Vector3d> inner_points(const SolidColumns& solid) {
  std::vector<Vector3d> points;
  for (std::size_t k = 0; k < solid.size(); ++k)
    for (const auto& [lo, hi] : solid.spans(k))
      for (double z = lo + solid.cell_m() / 2; z < hi; z += solid.cell_m())
        points.emplace_back(solid.x(k), solid.y(k), z);
  return points;
}

/// Lloyd's algorithm from random points; each cluster as the sphere of its volume.
Spheres clusters(const std::vector<Vector3d>& points, double cell_volume, int count,
                 std::mt19937& random) {
  Spheres out(static_cast<std::size_t>(count));
  for (Sphere& s : out) s.centre_m = points[random() % points.size()];
  for (int sweep = 0; sweep < 8; ++sweep) {
    std::vector<Vector3d> sum(out.size(), Vector3d::Zero());
    std::vector<int> members(out.size(), 0);
    for (const Vector3d& p : points) {
      std::size_t near = 0;
      for (std::size_t i = 1; i < out.size(); ++i)
        if ((p - out[i].centre_m).squaredNorm() < (p - out[near].centre_m).squaredNorm()) near = i;
      sum[near] += p;
      ++members[near];
    }
    for (std::size_t i = 0; i < out.size(); ++i) {
      if (members[i] > 0) out[i].centre_m = sum[i] / members[i];
      out[i].radius_m = std::cbrt(0.75 / M_PI * cell_volume * std::max(1, members[i]));
    }
  }
  return out;
}

/// Adam with a step that falls to zero.
void descend(const SolidColumns& solid, double diameter, double r_min,
             const std::vector<Vector3d>& normals, Spheres& spheres) {
  constexpr double kKeep = 0.9, kKeepSquare = 0.99;
  std::vector<Vector4d> mean(spheres.size(), Vector4d::Zero()), square = mean;
  for (int k = 1; k <= kSteps; ++k) {
    const double step = kFirstStep * diameter * (1 - static_cast<double>(k) / (kSteps + 1));
    Spheres next = spheres;
    for (std::size_t i = 0; i < spheres.size(); ++i) {
      const Vector4d g = gradient(solid, spheres, i, normals);
      mean[i] = kKeep * mean[i] + (1 - kKeep) * g;
      square[i] = kKeepSquare * square[i] + (1 - kKeepSquare) * g.cwiseAbs2();
      const Vector4d m = mean[i] / (1 - std::pow(kKeep, k));
      const Vector4d s = square[i] / (1 - std::pow(kKeepSquare, k));
      const Vector4d by =
          (step * m.array() / (s.array().sqrt() + 1e-4 * diameter * diameter)).matrix();
      next[i].centre_m -= by.head<3>();
      next[i].radius_m = std::max(r_min, next[i].radius_m - by[3]);
    }
    spheres = std::move(next);
  }
}

/// One offset of all radii gives the union the solid's volume.
void match_volume(double volume, double diameter, Spheres& spheres) {
  double lo = -0.1 * diameter, hi = 0.1 * diameter;
  const auto swollen = [&](double by) {
    Spheres out = spheres;
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

double least_radius(int count) { return 0.2 * std::cbrt(6.0 / std::max(6, count)); }

std::vector<Sphere> fit_spheres(const mesh::TriangleMesh& mesh, int count) {
  if (mesh.triangles.empty()) throw std::invalid_argument("the mesh has no facets");
  if (const auto faults = mesh::check_mesh(mesh); !faults.empty())
    throw std::invalid_argument("not a closed surface that faces outwards: " + faults[0].message);
  if (count < 1) throw std::invalid_argument("at least one sphere is needed");
  const double whole = mesh::volume(mesh), diameter = std::cbrt(6 * whole / M_PI);
  const SolidColumns solid(mesh, 64, 0.2 * diameter), coarse(mesh, 20, 0);
  const std::vector<Vector3d> points = inner_points(coarse), normals = directions(kSurfacePoints);
  if (points.empty()) throw std::invalid_argument("too thin to fit spheres in it");
  std::mt19937 random(1);
  Spheres best;
  double least = std::numeric_limits<double>::infinity();
  for (int start = 0; start < kStarts; ++start) {
    Spheres spheres = clusters(points, std::pow(coarse.cell_m(), 3), count, random);
    descend(solid, diameter, least_radius(count) * diameter, normals, spheres);
    const double now = mismatch(solid, spheres);
    if (now >= least) continue;
    least = now;
    best = std::move(spheres);
  }
  match_volume(whole, diameter, best);
  std::sort(best.begin(), best.end(),
            [](const Sphere& a, const Sphere& b) { return a.radius_m > b.radius_m; });
  return best;
}

double union_volume(const std::vector<Sphere>& spheres, int cells) {
  Box box;
  for (const Sphere& s : spheres) box.add(s.centre_m, s.radius_m);
  const Vector3d sides = box.sides_m();
  const double h = sides.maxCoeff() / cells;
  const auto nx = std::lround(std::ceil(sides.x() / h)), ny = std::lround(std::ceil(sides.y() / h));
  double length = 0;
  Spans spans;
  for (long i = 0; i < nx; ++i)
    for (long j = 0; j < ny; ++j) {
      union_spans(spheres, box.min_m.x() + (static_cast<double>(i) + 0.5) * h,
                  box.min_m.y() + (static_cast<double>(j) + 0.5) * h, spans);
      for (const auto& s : spans) length += s.second - s.first;
    }
  return length * h * h;
}

double symmetric_difference(const mesh::TriangleMesh& mesh, const std::vector<Sphere>& spheres) {
  const double whole = mesh::volume(mesh);
  return mismatch(SolidColumns(mesh, 160, 0.5 * std::cbrt(whole)), spheres) / whole;
}

}  // namespace dipper::deck
