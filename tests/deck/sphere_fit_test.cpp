#include "coupler/deck/sphere_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

#include "coupler/deck/rock_shape.hpp"
#include "tests/mesh/shapes.hpp"

namespace dipper {
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

TEST(FitSpheres, ASphereIsFoundByOne) {
  const std::vector<Sphere> fit = fit_spheres(test::sphere(0.5, 24), 1);
  EXPECT_NEAR(fit[0].radius_m, 0.5, 0.01);
  EXPECT_LT(fit[0].centre_m.norm(), 0.03);
}

TEST(FitSpheres, KeepsTheVolumeOfABoxAndBeatsOneSphere) {
  const TriangleMesh box = test::box({-0.6, -0.4, -0.3}, {0.6, 0.4, 0.3});
  const double volume = mass_properties(box).volume_m3;
  const std::vector<Sphere> six = fit_spheres(box, 6);
  ASSERT_EQ(six.size(), 6U);
  EXPECT_NEAR(union_volume(six, 400) / volume, 1, 1e-3);
  EXPECT_NEAR(monte_carlo_volume(six, 1.0, 1'000'000) / volume, 1, 0.01);
  EXPECT_LT(symmetric_difference(box, six), 0.30);
  EXPECT_LT(symmetric_difference(box, six), 0.6 * symmetric_difference(box, fit_spheres(box, 1)));
}

TEST(FitSpheres, RefusesAnOpenMesh) {
  TriangleMesh box = test::box({0, 0, 0}, {1, 1, 1});
  box.triangles.pop_back();
  EXPECT_THROW(fit_spheres(box, 3), std::invalid_argument);
}

TEST(RockShape, ACubeByItsKnownRatios) {
  const RockShape s = make_rock_shape("cube", test::box({5, 5, 5}, {7, 7, 7}), 8);
  EXPECT_NEAR(s.mass.volume_m3, M_PI / 6, 1e-12);
  EXPECT_LT(s.mass.com_m.norm(), 1e-12);
  EXPECT_NEAR(s.sphericity, std::cbrt(M_PI / 6), 1e-9);  // 0.806
  EXPECT_NEAR(s.aspect_ratio, 1, 0.5);                   // any axes are principal
}

}  // namespace
}  // namespace dipper
