#include "common/mesh/solids.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <utility>

namespace dipper::mesh {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Turns a solid's facets outwards, whichever way its corners were given.
TriangleMesh outwards(TriangleMesh mesh) {
  if (volume(mesh) < 0)
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

/// Joins rings of n vertices, the first to the second and so on; `closed`: the last to the first.
void join_rings(TriangleMesh& mesh, std::size_t n, bool closed) {
  const std::size_t rings = mesh.vertices.size() / n;
  for (std::size_t r = 0; r + (closed ? 0 : 1) < rings; ++r) {
    const std::size_t here = r * n, next = (r + 1) % rings * n;
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t l = (k + 1) % n;
      mesh.triangles.push_back({here + k, here + l, next + l});
      mesh.triangles.push_back({here + k, next + l, next + k});
    }
  }
}

void cap_ends(TriangleMesh& mesh, std::size_t n) {
  const std::size_t last = mesh.vertices.size() - n;
  for (std::size_t k = 1; k + 1 < n; ++k) {
    mesh.triangles.push_back({0, k + 1, k});
    mesh.triangles.push_back({last, last + k, last + k + 1});
  }
}

}  // namespace

TriangleMesh prism(const std::vector<Vector3d>& a, const std::vector<Vector3d>& b) {
  TriangleMesh mesh;
  mesh.vertices = a;
  mesh.vertices.insert(mesh.vertices.end(), b.begin(), b.end());
  join_rings(mesh, a.size(), false);
  cap_ends(mesh, a.size());
  return outwards(std::move(mesh));
}

TriangleMesh plate(const std::vector<Vector2d>& outline, double right, double left) {
  std::vector<Vector3d> a, b;
  for (const Vector2d& p : outline) {
    a.emplace_back(p.x(), right, p.y());
    b.emplace_back(p.x(), left, p.y());
  }
  return prism(a, b);
}

TriangleMesh block(const Vector3d& low, const Vector3d& high) {
  return plate({{low.x(), low.z()}, {high.x(), low.z()}, {high.x(), high.z()}, {low.x(), high.z()}},
               low.y(), high.y());
}

TriangleMesh rod(const std::vector<Vector3d>& way, double radius, std::size_t sides) {
  TriangleMesh mesh;
  Vector3d across = (way[1] - way[0]).unitOrthogonal();
  for (std::size_t i = 0; i < way.size(); ++i) {
    const Vector3d before = way[i] - way[i > 0 ? i - 1 : 0],
                   after = way[i + 1 < way.size() ? i + 1 : i] - way[i];
    const Vector3d along = (before.normalized() + after.normalized()).normalized();
    across = (across - along.dot(across) * along).normalized();
    const Vector3d other = along.cross(across);
    for (std::size_t k = 0; k < sides; ++k) {
      const double a = 2 * M_PI * static_cast<double>(k) / static_cast<double>(sides);
      mesh.vertices.emplace_back(way[i] + radius * (std::cos(a) * across + std::sin(a) * other));
    }
  }
  join_rings(mesh, sides, false);
  cap_ends(mesh, sides);
  return outwards(std::move(mesh));
}

TriangleMesh turned(const std::vector<Vector2d>& section, const Vector3d& centre,
                    std::size_t sides) {
  TriangleMesh mesh;
  for (std::size_t k = 0; k < sides; ++k) {
    const double a = 2 * M_PI * static_cast<double>(k) / static_cast<double>(sides);
    for (const Vector2d& p : section)
      mesh.vertices.emplace_back(centre +
                                 Vector3d(p.x() * std::cos(a), p.y(), p.x() * std::sin(a)));
  }
  join_rings(mesh, section.size(), true);
  return outwards(std::move(mesh));
}

void append(TriangleMesh& to, const TriangleMesh& more) {
  const std::size_t at = to.vertices.size();
  to.vertices.insert(to.vertices.end(), more.vertices.begin(), more.vertices.end());
  for (const auto& t : more.triangles) to.triangles.push_back({at + t[0], at + t[1], at + t[2]});
}

TriangleMesh both_sides(const TriangleMesh& left) {
  TriangleMesh both = left, right = left;
  for (auto& v : right.vertices) v.y() = -v.y();
  append(both, outwards(std::move(right)));
  return both;
}

}  // namespace dipper::mesh
