#include "coupler/deck/domain_split.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "coupler/deck/pile_shape.hpp"
#include "tests/coupler/deck/quick_case.hpp"

namespace dipper::deck {
namespace {

using testing::ElementsAre;

TEST(DomainSplit, OneAndTwoRanks) {
  const cases::Case c = quick_case();
  EXPECT_THAT(best_split(c, 1).parts, ElementsAre(1, 1, 1));
  EXPECT_DOUBLE_EQ(best_split(c, 1).largest_fraction, 1);
  // The bench lies on both sides of y = 0, the middle of the box; all of it is at large x, small z.
  EXPECT_THAT(best_split(c, 2).parts, ElementsAre(1, 2, 1));
  EXPECT_NEAR(best_split(c, 2).largest_fraction, 0.5, 1e-9);
}

TEST(DomainSplit, SharesByHand) {
  // A bench that fills the box's upper half of x as one block, and a third of y's parts.
  cases::Case c = quick_case();
  c.domain.min_m = {0, -12, 0};
  c.domain.max_m = {20, 12, 10};
  c.pile.toe_x_m = 10;
  c.pile.face_angle_deg = 89.999;
  c.pile.crest_depth_m = 10;
  c.pile.height_m = 10;
  c.pile.width_m = 8;
  // 4 parts along x: two full; 2 along z: both; 3 along y: the middle one only.
  EXPECT_NEAR(best_split(c, 4).largest_fraction, 0.25, 1e-3);
  EXPECT_NEAR(best_split(c, 3).largest_fraction, 1.0 / 3, 1e-3);
  EXPECT_THAT(best_split(c, 3).parts, ElementsAre(1, 1, 3));
  EXPECT_NEAR(best_split(c, 8).largest_fraction, 0.125, 1e-3);
}

TEST(DomainSplit, FollowsAProfile) {
  // Nine tenths of the section lie in the middle fifth of the box.
  cases::Case c = quick_case();
  c.domain.min_m = {0, -12, 0};
  c.domain.max_m = {20, 12, 10};
  c.pile.width_m = 24;
  c.pile.profile = "scan.csv";
  c.pile.outline_m = {{8, 0}, {8, 9}, {12, 9}, {12, 1}, {16, 1}};
  // By hand: along x in 5, the fullest part has 36 of 40 m2; along y in 5, a fifth each.
  EXPECT_THAT(best_split(c, 5).parts, ElementsAre(1, 5, 1));
  EXPECT_NEAR(best_split(c, 5).largest_fraction, 0.2, 1e-9);
  // Only x and z: 2 parts along x share at x = 10, the middle of the block: 18 and 22 m2.
  c.pile.width_m = 1;
  c.domain.min_m.y() = -0.6;
  c.domain.max_m.y() = 1e3;
  EXPECT_THAT(best_split(c, 2).parts, ElementsAre(2, 1, 1));
  EXPECT_NEAR(best_split(c, 2).largest_fraction, 22.0 / 40, 5e-3);
}

TEST(DomainSplit, IsNeverWorseThanAcrossTheWidth) {
  const cases::Case c = quick_case();
  const double part = (c.domain.max_m.y() - c.domain.min_m.y());
  for (const int ranks : {2, 4, 6, 8, 16}) {
    const DomainSplit best = best_split(c, ranks);
    EXPECT_EQ(best.parts[0] * best.parts[1] * best.parts[2], ranks);
    // Cuts at multiples of the box's width over the ranks: the fullest holds this much.
    const double across = std::min(0.5, part / ranks / c.pile.width_m);
    EXPECT_LE(best.largest_fraction, across + 1e-9) << ranks;
  }
  EXPECT_LT(best_split(c, 8).largest_fraction, 0.35);  // across the width: 0.5
}

}  // namespace
}  // namespace dipper::deck
