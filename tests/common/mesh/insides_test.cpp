#include "common/mesh/insides.hpp"

#include <gtest/gtest.h>

#include <random>

#include "common/mesh/signed_distance.hpp"
#include "common/mesh/solids.hpp"
#include "tests/common/mesh/shapes.hpp"

namespace dipper::mesh {
namespace {

using Eigen::Vector3d;

/// A hollow wall, a sphere across a box, and a box that touches that box.
TriangleMesh several_shells() {
  TriangleMesh mesh = turned({{1.0, 0.0}, {1.5, 0.0}, {1.5, 2.0}, {1.0, 2.0}}, {4, 0, 0}, 12);
  append(mesh, test::box({0, 0, 0}, {1, 1, 1}));
  append(mesh, test::sphere(0.8, 6));
  append(mesh, test::box({1, 0, 0}, {2, 1, 1}));
  return mesh;
}

TEST(Insides, AgreeWithTheSignedDistance) {
  const TriangleMesh mesh = several_shells();
  const Insides insides(mesh);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> x(-1, 6), y(-1, 2.5), z(-2, 2);
  int inside = 0;
  for (int k = 0; k < 5000; ++k) {
    const Vector3d p(x(random), y(random), z(random));
    EXPECT_EQ(insides.holds(p), signed_distance(mesh, p) > 0) << p.transpose();
    inside += insides.holds(p) ? 1 : 0;
  }
  EXPECT_GT(inside, 200);
}

TEST(Insides, PointsUnderEdgesAndCorners) {
  const TriangleMesh mesh = test::box({0, 0, 0}, {1, 1, 1});
  const Insides insides(mesh);
  for (const double at : {0.25, 0.5, 0.75}) {  // the diagonals of floor and roof
    EXPECT_TRUE(insides.holds({at, at, 0.5}));
    EXPECT_TRUE(insides.holds({at, 1 - at, 0.5}));
    EXPECT_FALSE(insides.holds({at, at, 1.5}));
    EXPECT_FALSE(insides.holds({at, at, -0.5}));
  }
}

TEST(Insides, SurfaceThatIsNear) {
  const TriangleMesh mesh = test::box({0, 0, 0}, {1, 1, 1});
  EXPECT_TRUE(is_surface_near(mesh, {0.5, 0.5, 0.8}, 0.21));
  EXPECT_FALSE(is_surface_near(mesh, {0.5, 0.5, 0.8}, 0.19));
}

}  // namespace
}  // namespace dipper::mesh
