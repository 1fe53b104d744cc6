#include "analysis/rock/pile_angle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

namespace dipper::analysis::rock {
namespace {

constexpr double kDegree = M_PI / 180;

/// A pile under a plane of known angle: spheres of mixed sizes at random regions, tops at most a
/// metre under z = tan(angle) x (what lies deeper is not seen). Faces -x.
struct Heap {
  double angle_deg = 35;
  double height_m = 12;
  double width_m = 12;
  double roughness_m =
      0.0;  ///< each sphere stands out of or lies under the plane by so much, sigma
  bool toe_and_crest = false;
  std::size_t flyers = 0;  ///< rocks in the air over the flank, and as many on the ground before it
  unsigned seed = 1;

  /// Of the mean surface.
  double z(double x) const {
    const double slope = std::tan(angle_deg * kDegree), top = height_m;
    const double straight = std::min(slope * x, top);
    if (!toe_and_crest) return std::max(0.0, straight);
    // Parabolas over the lowest and highest 15 %, tangent to the plane.
    const double run = 0.15 * top / slope;
    const auto bend = [&](double d) { return slope * (d + run) * (d + run) / (4 * run); };
    if (x < -run) return 0;
    if (x < run) return bend(x);
    const double back = top / slope - x;
    if (back < -run) return top;
    if (back < run) return top - bend(back);
    return straight;
  }

  std::vector<Sphere> balls() const {
    std::mt19937 draw(seed);
    const auto uniform = [&](double lo, double hi) {
      return lo + (hi - lo) * static_cast<double>(draw()) / 4294967295.0;
    };
    std::normal_distribution<double> rough(0, roughness_m > 0 ? roughness_m : 1);
    std::vector<Sphere> out;
    const double run = height_m / std::tan(angle_deg * kDegree);
    while (out.size() < 25'000) {
      const double r = uniform(0, 1) < 0.9 ? 0.2 : uniform(0.25, 0.425);
      const double x = uniform(-3, run + 4), y = uniform(-width_m / 2, width_m / 2);
      const double out_by = roughness_m > 0 ? rough(draw) : 0;
      out.push_back({{x, y, z(x) - uniform(0, 1) + out_by - r}, r});
    }
    for (std::size_t i = 0; i < flyers; ++i) {
      const double x = uniform(1, run - 1);
      out.push_back({{x, uniform(-width_m / 2, width_m / 2), z(x) + uniform(1, 6)}, 0.5});
      out.push_back({{uniform(-3, -0.5), uniform(-width_m / 2, width_m / 2), 0.5}, 0.5});
    }
    return out;
  }
};

TEST(PileAngle, PlanesOfKnownAngle) {
  for (const double angle : {20.0, 27.5, 34.7, 42.0, 50.0}) {
    Heap heap;
    heap.angle_deg = angle;
    const PileAngle a = pile_angle(heap.balls());
    EXPECT_NEAR(a.angle_deg, angle, 0.3);
    EXPECT_GT(a.slope, 0);
    EXPECT_NEAR(a.height_m, 12, 0.4);
  }
}

TEST(PileAngle, NoiseOutliersToeAndCrestDoNotBend) {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    Heap heap;
    heap.angle_deg = 34.7;
    heap.roughness_m = 0.15;
    heap.toe_and_crest = true;
    heap.flyers = 12;
    heap.seed = seed;
    const PileAngle a = pile_angle(heap.balls());
    EXPECT_NEAR(a.angle_deg, 34.7, 0.3) << "seed " << seed;
    EXPECT_LT(a.sigma_deg, 0.6);
    EXPECT_GT(a.sigma_deg, 0.02);
  }
}

TEST(PileAngle, TheOtherWayRoundIsTheSameAngle) {
  Heap heap;
  heap.toe_and_crest = true;
  std::vector<Sphere> balls = heap.balls();
  const PileAngle a = pile_angle(balls);
  for (Sphere& b : balls) b.centre_m.x() *= -1;
  const PileAngle mirrored = pile_angle(balls);
  EXPECT_NEAR(mirrored.angle_deg, a.angle_deg, 0.1);
  EXPECT_LT(mirrored.slope, 0);
}

/// A profile with known residuals: the bootstrap's figure against the closed form for a least
/// squares slope with independent noise, which a Theil-Sen slope reaches within some percent.
TEST(PileAngle, SigmaIsThatOfIndependentNoise) {
  std::mt19937 draw(3);
  std::normal_distribution<double> noise(0, 0.05);
  double sum = 0;
  constexpr int kProfiles = 20, kBins = 101;
  constexpr double kStep = 0.1;
  for (int k = 0; k < kProfiles; ++k) {
    SurfaceProfile p;
    p.step_m = kStep;
    for (int i = 0; i < kBins; ++i) {
      p.x_m.push_back(kStep * i);
      p.z_m.push_back(0.7 * kStep * i + noise(draw));
    }
    sum += pile_angle(p, kStep).sigma_deg;
  }
  // Bins between 20 % and 80 % of the height.
  const double n = 0.6 * kBins, spread = n * n * n * kStep * kStep / 12;
  const double expected =
      std::cos(std::atan(0.7)) * std::cos(std::atan(0.7)) * 0.05 / std::sqrt(spread) / kDegree;
  EXPECT_NEAR(sum / kProfiles, expected, 0.2 * expected);
}

TEST(PileAngle, AThirdOfTheBinsMayBeWrongAlmost) {
  SurfaceProfile p;
  p.step_m = 0.1;
  for (int i = 0; i < 101; ++i) {
    p.x_m.push_back(0.1 * i);
    p.z_m.push_back(0.7 * 0.1 * i);
  }
  for (const std::size_t i : {25, 30, 37, 44, 45, 51, 58, 62, 70, 74, 77, 80}) p.z_m[i] += 1.5;
  EXPECT_NEAR(pile_angle(p, 0.1).angle_deg, std::atan(0.7) / kDegree, 0.3);
}

TEST(PileAngle, SaysWhenThereIsNoFlank) {
  EXPECT_THROW(pile_angle(std::vector<Sphere>{}), std::invalid_argument);
  EXPECT_THROW(pile_angle({{{0, 0, 0.2}, 0.2}}), std::invalid_argument);
  std::vector<Sphere> slab;  // a level bed between walls
  for (int i = 0; i < 50; ++i)
    for (int j = 0; j < 10; ++j) slab.push_back({{0.4 * i, 0.4 * j, 0.2}, 0.2});
  EXPECT_THROW(pile_angle(slab), std::invalid_argument);
}

TEST(SurfaceProfile, OfOneBallIsItsTop) {
  const SurfaceProfile p = surface_profile({{{1, 0, 0.5}, 0.5}}, {0, 0.5, 0});
  ASSERT_EQ(p.x_m.size(), 2U);  // bins of 0.5 m
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(p.x_m[i], 0.75 + 0.5 * static_cast<double>(i), 1e-12);
    EXPECT_NEAR(p.z_m[i], 0.5 + std::sqrt(0.25 - 0.0625), 0.06);
  }
}

TEST(SurfaceProfile, OfALevelBedIsLevel) {
  std::vector<Sphere> bed;
  for (int i = 0; i < 40; ++i)
    for (int j = 0; j < 10; ++j) bed.push_back({{0.2 * i, 0.2 * j, 1.0}, 0.2});
  const SurfaceProfile p = surface_profile(bed);
  for (std::size_t i = 2; i + 2 < p.z_m.size(); ++i) EXPECT_NEAR(p.z_m[i], 1.18, 0.02);
}

TEST(SurfaceProfile, RefusesWhatIsNoSphere) {
  EXPECT_THROW(surface_profile({}), std::invalid_argument);
  EXPECT_THROW(surface_profile({{{0, 0, 0}, 0}}), std::invalid_argument);
  EXPECT_THROW(surface_profile({{{NAN, 0, 0}, 1}}), std::invalid_argument);
}

}  // namespace
}  // namespace dipper::analysis::rock
