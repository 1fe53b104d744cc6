#include "coupler/deck/pile_walls.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "coupler/deck/pile_shape.hpp"

namespace dipper::deck {
namespace {

using Eigen::Vector3d;

constexpr double kFacet_m = 1.2;
constexpr double kMargin_m = 1.0;  // of the walls over the bench, and in front of the toe
// Walls reach below the ground: a rock at the foot must not find the edge of a facet.
constexpr double kFoot_m = 0.3;

/// Facets of a rectangle with sides u, v and outward normal u x v, where `keep` (of the facet's
/// corner nearest the origin corner) says so.
void add_rectangle(mesh::TriangleMesh& mesh, const Vector3d& corner, const Vector3d& u,
                   const Vector3d& v, const std::function<bool(const Vector3d&)>& keep) {
  const int nu = std::max(1, static_cast<int>(std::lround(u.norm() / kFacet_m)));
  const int nv = std::max(1, static_cast<int>(std::lround(v.norm() / kFacet_m)));
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j) {
      const auto at = [&](int a, int b) {
        return Vector3d(corner + u * (static_cast<double>(i + a) / nu) +
                        v * (static_cast<double>(j + b) / nv));
      };
      if (!keep(at(0, 0)) && !keep(at(1, 0))) continue;
      mesh.add_loose({at(0, 0), at(1, 0), at(1, 1)});
      mesh.add_loose({at(0, 0), at(1, 1), at(0, 1)});
    }
}

/// Sides and rear over x0 ... rear, up to `top`.
mesh::TriangleMesh sides_and_rear(const cases::Case& c, double x0, double top,
                                  const std::function<bool(const Vector3d&)>& keep) {
  const double y = c.pile.width_m / 2, x1 = pile_shape(c).rear_x_m, z0 = -kFoot_m;
  const Vector3d along(x1 - x0, 0, 0), across(0, 2 * y, 0), up(0, 0, top - z0);
  mesh::TriangleMesh mesh;
  add_rectangle(mesh, {x0, y, z0}, along, up, keep);  // normal -y
  const std::size_t turned = mesh.triangles.size();
  add_rectangle(mesh, {x0, -y, z0}, along, up, keep);   // normal -y
  add_rectangle(mesh, {x1, -y, z0}, across, up, keep);  // normal +x
  for (std::size_t i = turned; i < mesh.triangles.size(); ++i)
    std::swap(mesh.triangles[i][1], mesh.triangles[i][2]);
  return mesh;
}

}  // namespace

mesh::TriangleMesh funnel_walls(const cases::Case& c) {
  const PileShape p = pile_shape(c);
  const double y = c.pile.width_m / 2, x0 = p.toe_x_m;
  const auto all = [](const Vector3d&) { return true; };
  mesh::TriangleMesh mesh = sides_and_rear(c, x0 - kMargin_m, p.pour_height_m + kMargin_m, all);
  // Through the toe line, as steep as the pour's front; continued to both ends.
  const Vector3d slope(p.pour_run_m, 0, p.pour_height_m);
  const Vector3d below = -slope * (kFoot_m / slope.z()), foot(x0, -y, 0);
  add_rectangle(mesh, foot + below, slope - below, {0, 2 * y, 0}, all);
  return mesh;
}

mesh::TriangleMesh bench_walls(const cases::Case& c) {
  const PileShape p = pile_shape(c);
  const cases::BenchOutline bench = bench_outline(c);
  return sides_and_rear(c, p.toe_x_m - kMargin_m, p.height_m + kMargin_m, [&](const Vector3d& at) {
    return at.z() < cases::outline_height(bench, at.x()) + kMargin_m;
  });
}

}  // namespace dipper::deck
