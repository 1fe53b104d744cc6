#include "common/mesh/solids.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/mesh/mesh_check.hpp"

namespace dipper::mesh {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

void expect_solid(const TriangleMesh& mesh, double volume_m3) {
  const auto faults = check_mesh(mesh);
  EXPECT_TRUE(faults.empty()) << faults[0].message;
  EXPECT_NEAR(volume(mesh), volume_m3, 1e-9);
}

TEST(Solids, AreClosedFaceOutwardsAndHaveTheirVolumes) {
  expect_solid(block({-1, 0, 2}, {1, 3, 4}), 12);
  expect_solid(plate({{0, 0}, {2, 0}, {0, 1}}, -1, 2), 3);
  // Six sides: area 1.5 sqrt(3) r^2.
  const double hexagon = 1.5 * std::sqrt(3.0);
  expect_solid(rod({{0, 0, 0}, {0, 0, 5}}, 0.5, 6), 0.25 * hexagon * 5);
  const TriangleMesh bent = rod({{0, 0, 0}, {3, 0, 0}, {3, 4, 0}}, 0.5, 8);
  expect_solid(bent, volume(bent));
  // A ring of four sides: the outer square less the inner one, of half diagonals 2 and 1.
  const TriangleMesh ring = turned({{1, 0}, {2, 0}, {2, 1}, {1, 1}}, {0, 0, 7}, 4);
  expect_solid(ring, 8 - 2);
  EXPECT_NEAR(bounding_box(ring).max_m.z(), 9, 1e-12);
  expect_solid(both_sides(block({0, 1, 0}, {1, 2, 1})), 2);
}

}  // namespace
}  // namespace dipper::mesh
