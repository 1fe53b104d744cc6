#include "analysis/rock/load.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/frames.hpp"

namespace dipper::analysis::rock {
namespace {

/// Small balls on a lattice that fill x and y of the region and reach up to z = height.
std::vector<Sphere> bed(const Box& region, double height) {
  constexpr double r = 0.02;
  std::vector<Sphere> balls;
  for (double x = region.min_m.x() + r; x < region.max_m.x(); x += 2 * r)
    for (double y = region.min_m.y() + r; y < region.max_m.y(); y += 2 * r)
      balls.push_back({{x, y, height - r}, 1.5 * r});
  return balls;
}

const Box kBox{{0, -1, -0.5}, {3, 1, 1.5}};

TEST(LoadVolume, ReachesFromTheBottomToTheTopOfTheHighestSphere) {
  const double top = 0.7 + 0.01;  // balls of 3 cm about z = 0.68, less the dents between them
  EXPECT_NEAR(load_volume(bed(kBox, 0.7), Vector3d::UnitZ(), kBox, 0.01), 3 * 2 * (top + 0.5),
              0.015 * 6);
}

TEST(LoadVolume, HalfABoxIsHalfAsMuch) {
  std::vector<Sphere> balls;
  for (const Sphere& b : bed(kBox, 0.7))
    if (b.centre_m.x() < 1.5) balls.push_back(b);
  EXPECT_NEAR(load_volume(balls, Vector3d::UnitZ(), kBox, 0.01),
              load_volume(bed(kBox, 0.7), Vector3d::UnitZ(), kBox, 0.01) / 2, 0.06);
}

TEST(LoadVolume, ATiltedBoxIsFilledAlongGravity) {
  // Held with its x axis 30 degrees up, filled to its upper corner everywhere: the whole box.
  const Vector3d up(std::sin(M_PI / 6), 0, std::cos(M_PI / 6));
  std::vector<Sphere> balls;
  for (double x = -2; x < 5; x += 0.05)
    for (double y = -0.99; y < 1; y += 0.05) balls.push_back({{x, y, 1.6}, 0.05});
  EXPECT_NEAR(load_volume(balls, up, kBox, 0.02), 3 * 2 * 2, 0.12);
}

TEST(LoadVolume, NoBallsNoLoad) { EXPECT_EQ(load_volume({}, Vector3d::UnitZ(), kBox, 0.1), 0); }

}  // namespace
}  // namespace dipper::analysis::rock
