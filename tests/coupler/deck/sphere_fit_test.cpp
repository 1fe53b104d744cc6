#include "coupler/deck/sphere_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

#include "common/mesh/mass_properties.hpp"
#include "coupler/deck/solid_columns.hpp"
#include "tests/common/mesh/shapes.hpp"

namespace dipper::deck {
namespace {

using Eigen::Vector3d;

double monte_carlo_volume(const std::vector<Sphere>& spheres, double half, int tries) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> u(-half, half);
  int hits = 0;
  for (int i = 0; i < tries; ++i) {
    const Vector3d p(u(random), u(random), u(random));
    for (const Sphere& s : spheres)
      if ((p - s.centre_m).norm() < s.radius_m) {
        ++hits;
        break;
      }
  }
  return std::pow(2 * half, 3) * hits / tries;
}

TEST(UnionVolume, OneSphere) {
  EXPECT_NEAR(union_volume({{Vector3d(1, 2, 3), 0.5}}), M_PI / 6, 1e-4);
}

TEST(UnionVolume, TwoSpheresShareALens) {
  // Lens of two unit spheres at distance d: pi (4 + d)(2 - d)^2 / 12.
  const double d = 0.8, lens = M_PI * (4 + d) * (2 - d) * (2 - d) / 12;
  const std::vector<Sphere> two = {{Vector3d(0, 0, 0), 1}, {Vector3d(d, 0, 0), 1}};
  EXPECT_NEAR(union_volume(two, 300), 8 * M_PI / 3 - lens, 2e-3);
}

TEST(SolidColumns, ABoxWithLinesOnItsEdges) {
  // 10 lines a metre from the corner: some run exactly along the diagonals of the faces.
  const SolidColumns box(test::box({0, 0, 0}, {1, 1, 0.5}), 10, 0);
  EXPECT_NEAR(box.volume_m3(), 0.5, 1e-12);
  EXPECT_TRUE(box.inside({0.35, 0.35, 0.49}));
  EXPECT_FALSE(box.inside({0.35, 0.35, 0.51}));
  EXPECT_FALSE(box.inside({-0.05, 0.35, 0.2}));
}

TEST(SolidColumns, SpansJoinAndDiffer) {
  Spans a = {{3, 4}, {0, 1}, {0.5, 2}};
  join(a);
  EXPECT_EQ(a, (Spans{{0, 2}, {3, 4}}));
  EXPECT_DOUBLE_EQ(difference(a, {{1, 3.5}}), 1 + 1 + 0.5);
  EXPECT_DOUBLE_EQ(difference(a, {}), 3);
}

TEST(FitSpheres, FindsTwoSpheresInTheirOwnDumbbell) {
  // A mesh that two spheres fit exactly: shells that overlap count once.
  mesh::TriangleMesh mesh = test::sphere(0.5, 32);
  const mesh::TriangleMesh other = test::sphere(0.35, 32);
  const std::size_t n = mesh.vertices.size();
  for (const Vector3d& v : other.vertices) mesh.vertices.push_back(v + Vector3d(0.6, 0.1, 0.2));
  for (const auto& t : other.triangles) mesh.triangles.push_back({t[0] + n, t[1] + n, t[2] + n});
  const double both = union_volume({{Vector3d(0, 0, 0), 0.5}, {Vector3d(0.6, 0.1, 0.2), 0.35}});
  EXPECT_NEAR(SolidColumns(mesh, 200, 0).volume_m3(), both, 0.01 * both);
  const std::vector<Sphere> fit = fit_spheres(mesh, 2);
  EXPECT_LT(symmetric_difference(mesh, fit), 0.05);
  EXPECT_LT((fit[0].centre_m).norm(), 0.03);
  EXPECT_LT((fit[1].centre_m - Vector3d(0.6, 0.1, 0.2)).norm(), 0.03);
}

TEST(FitSpheres, MoreSpheresFitBetter) {
  const mesh::TriangleMesh box = test::box({-0.6, -0.4, -0.3}, {0.6, 0.4, 0.3});
  const double six = symmetric_difference(box, fit_spheres(box, 6)),
               twelve = symmetric_difference(box, fit_spheres(box, 12)),
               many = symmetric_difference(box, fit_spheres(box, 24));
  EXPECT_LT(six, 0.23);
  EXPECT_LT(twelve, 0.85 * six);
  EXPECT_LT(many, 0.85 * twelve);
}

TEST(FitSpheres, ASphereIsFoundByOne) {
  const std::vector<Sphere> fit = fit_spheres(test::sphere(0.5, 24), 1);
  EXPECT_NEAR(fit[0].radius_m, 0.5, 0.01);
  EXPECT_LT(fit[0].centre_m.norm(), 0.03);
}

TEST(FitSpheres, KeepsTheVolumeOfABoxAndBeatsOneSphere) {
  const mesh::TriangleMesh box = test::box({-0.6, -0.4, -0.3}, {0.6, 0.4, 0.3});
  const double volume = mesh::mass_properties(box).volume_m3;
  const std::vector<Sphere> six = fit_spheres(box, 6);
  ASSERT_EQ(six.size(), 6U);
  EXPECT_NEAR(union_volume(six, 400) / volume, 1, 1e-3);
  EXPECT_NEAR(monte_carlo_volume(six, 1.0, 400'000) / volume, 1, 0.01);
  EXPECT_LT(symmetric_difference(box, six), 0.23);
  EXPECT_LT(symmetric_difference(box, six), 0.6 * symmetric_difference(box, fit_spheres(box, 1)));
}

TEST(FitSpheres, RefusesAnOpenMesh) {
  mesh::TriangleMesh box = test::box({0, 0, 0}, {1, 1, 1});
  box.triangles.pop_back();
  EXPECT_THROW(fit_spheres(box, 3), std::invalid_argument);
}

}  // namespace
}  // namespace dipper::deck
