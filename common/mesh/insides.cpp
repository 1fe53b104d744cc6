#include "common/mesh/insides.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace dipper::mesh {
namespace {

using Eigen::Vector3d;

constexpr double kMostColumns = 1000;  // along an axis

/// Whether p is to the left of the way from `low` up to `high`, in the plane of x and y.
bool is_left(const Vector3d& low, const Vector3d& high, const Vector3d& p) {
  return (high.x() - low.x()) * (p.y() - low.y()) > (high.y() - low.y()) * (p.x() - low.x());
}

/// Whether p is over or under a triangle; of facets that share an edge, of one only: a line from p
/// along x crosses an edge from its lower end, inclusive, to its upper.
bool covers(const Triangle& t, const Vector3d& p) {
  bool inside = false;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3d &a = t[i], &b = t[(i + 1) % 3];
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    if (a.y() < b.y() ? is_left(a, b, p) : is_left(b, a, p)) inside = !inside;
  }
  return inside;
}

}  // namespace

Insides::Insides(const TriangleMesh& mesh)
    : mesh_(mesh),
      box_(bounding_box(mesh)),
      n_(static_cast<std::size_t>(
          std::clamp(std::sqrt(static_cast<double>(mesh.triangles.size())), 1.0, kMostColumns))),
      facets_(n_ * n_) {
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    Box of_facet;
    for (const Vector3d& corner : mesh.corners(f)) of_facet.add(corner);
    for (std::size_t i = column(of_facet.min_m.x(), 0); i <= column(of_facet.max_m.x(), 0); ++i)
      for (std::size_t j = column(of_facet.min_m.y(), 1); j <= column(of_facet.max_m.y(), 1); ++j)
        facets_[i * n_ + j].push_back(f);
  }
}

std::size_t Insides::column(double x, int axis) const {
  const double side = box_.sides_m()[axis];
  if (side <= 0) return 0;
  const double n = static_cast<double>(n_);
  return static_cast<std::size_t>(std::clamp(n * (x - box_.min_m[axis]) / side, 0.0, n - 1));
}

bool Insides::holds(const Vector3d& p) const {
  if (!box_.holds(p)) return false;
  int shells = 0;
  for (const std::size_t f : facets_[column(p.x(), 0) * n_ + column(p.y(), 1)]) {
    const Triangle t = mesh_.corners(f);
    if (!covers(t, p)) continue;
    const Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
    if (normal.z() == 0 || normal.dot(p - t[0]) * normal.z() > 0) continue;  // upright, or below p
    shells += normal.z() > 0 ? 1 : -1;
  }
  return shells > 0;
}

}  // namespace dipper::mesh
