#include "analysis/rock/solid_mass.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace dipper::analysis::rock {
namespace {

Box cube(double side) { return {Eigen::Vector3d::Zero(), Eigen::Vector3d::Constant(side)}; }

/// Spheres that touch on a cubic lattice fill pi/6 of the space.
TEST(MassInside, CubicLatticeOfSpheres) {
  std::vector<Sphere> balls;
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 5; ++j)
      for (int k = 0; k < 5; ++k) balls.push_back({{i + 0.5, j + 0.5, k + 0.5}, 0.5});
  const std::vector<double> density(balls.size(), 3000);
  const double exact = 3000 * M_PI / 6;
  // 113 cells to 5 spheres: each lies differently on the grid, or all had the same error.
  EXPECT_NEAR(mass_inside(balls, density, cube(5), 0.0442) / 125, exact, 0.003 * exact);
  // A window that cuts spheres on every side holds its share: two whole periods.
  const Box shifted{{1.3, 1.45, 1.7}, {3.3, 3.45, 3.7}};
  EXPECT_NEAR(mass_inside(balls, density, shifted, 0.02) / 8, exact, 0.003 * exact);
}

TEST(MassInside, ACapCountsAsFarAsItReachesIn) {
  // Centre 0.2 m over the box's top: the cap of height 0.3 of a sphere of radius 0.5.
  const double h = 0.3, cap = M_PI * h * h * (0.5 - h / 3);
  EXPECT_NEAR(mass_inside({{{0.5, 0.5, 1.2}, 0.5}}, {1000}, cube(1), 0.01), 1000 * cap,
              0.01 * 1000 * cap);
  EXPECT_EQ(mass_inside({{{0.5, 0.5, 1.6}, 0.5}}, {1000}, cube(1), 0.01), 0);
}

TEST(MassInside, SpaceInTwoBallsOfARockCountsOnce) {
  const std::vector<Sphere> twice = {{{0.5, 0.5, 0.5}, 0.3}, {{0.5, 0.5, 0.5}, 0.3}};
  const double once = 1000 * 4 / 3.0 * M_PI * 0.027;
  EXPECT_NEAR(mass_inside(twice, {1000, 1000}, cube(1), 0.01), once, 0.005 * once);
}

TEST(MassInside, RefusesWhatHasNoAnswer) {
  EXPECT_THROW(mass_inside({{{0, 0, 0}, 1}}, {}, cube(1), 0.1), std::invalid_argument);
  EXPECT_THROW(mass_inside({}, {}, cube(0), 0.1), std::invalid_argument);
  EXPECT_THROW(mass_inside({}, {}, cube(1), 0), std::invalid_argument);
}

}  // namespace
}  // namespace dipper::analysis::rock
