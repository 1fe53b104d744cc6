#include "common/mesh/mass_properties.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/mesh/mesh_check.hpp"
#include "common/mesh/signed_distance.hpp"
#include "tests/common/mesh/shapes.hpp"

namespace dipper::mesh {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

TEST(MassProperties, UnitCubeIsExact) {
  const TriangleMesh cube = test::box({0, 0, 0}, {1, 1, 1});
  const MassProperties m = mass_properties(cube);
  EXPECT_TRUE(check_mesh(cube).empty());
  EXPECT_NEAR(m.volume_m3, 1, 1e-15);
  EXPECT_NEAR(m.area_m2, 6, 1e-14);
  EXPECT_TRUE(m.com_m.isApprox(Vector3d::Constant(0.5), 1e-14));
  EXPECT_TRUE(m.inertia_m5.isApprox(Matrix3d::Identity() / 6, 1e-13));
}

TEST(MassProperties, BoxFarFromTheOrigin) {
  const MassProperties m = mass_properties(test::box({10, -7, 3}, {12, -4, 8}));
  const double a = 2, b = 3, c = 5, v = a * b * c;
  EXPECT_NEAR(m.volume_m3, v, 1e-12);
  EXPECT_TRUE(m.com_m.isApprox(Vector3d(11, -5.5, 5.5), 1e-13));
  const Matrix3d want =
      v / 12 * Vector3d(b * b + c * c, a * a + c * c, a * a + b * b).asDiagonal().toDenseMatrix();
  EXPECT_TRUE(m.inertia_m5.isApprox(want, 1e-10));
}

TEST(MassProperties, CornerTetrahedron) {
  // x, y, z >= 0, x + y + z <= 1: V = 1/6, centroid 1/4, about it Ixx = 1/80, Ixy = +1/480.
  const TriangleMesh t = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                          {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}}};
  const MassProperties m = mass_properties(t);
  EXPECT_TRUE(check_mesh(t).empty());
  EXPECT_NEAR(m.volume_m3, 1.0 / 6, 1e-15);
  EXPECT_TRUE(m.com_m.isApprox(Vector3d::Constant(0.25), 1e-14));
  EXPECT_NEAR(m.inertia_m5(0, 0), 1.0 / 80, 1e-15);
  EXPECT_NEAR(m.inertia_m5(0, 1), 1.0 / 480, 1e-15);
}

TEST(MassProperties, SphereConvergesWithTheSquareOfTheFacet) {
  const auto error = [](int n) {
    return 1 - mass_properties(test::sphere(1.0, n)).volume_m3 / (4 * M_PI / 3);
  };
  EXPECT_NEAR(error(20) / error(40), 4, 0.1);
  const MassProperties m = mass_properties(test::sphere(2.0, 60));
  EXPECT_NEAR(m.inertia_m5(0, 0) / (0.4 * m.volume_m3 * 4), 1, 0.005);
}

TEST(SignedDistance, InsideIsPositive) {
  const TriangleMesh cube = test::box({0, 0, 0}, {1, 1, 1});
  EXPECT_NEAR(signed_distance(cube, {0.5, 0.5, 0.7}), 0.3, 1e-14);
  EXPECT_NEAR(signed_distance(cube, {0.5, 0.5, 1.7}), -0.7, 1e-14);
  EXPECT_NEAR(signed_distance(cube, {2, 2, 2}), -std::sqrt(3.0), 1e-14);
}

}  // namespace
}  // namespace dipper::mesh
