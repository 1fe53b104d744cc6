#include "coupler/deck/collapse.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <regex>

#include "tests/coupler/deck/liggghts_run.hpp"
#include "tests/coupler/deck/quick_case.hpp"
#include "tests/places.hpp"

namespace dipper::deck {
namespace {

// The bench of quick_case: 8 x 8 m under 35 degrees, crest 2 m deep, largest rocks 1.7 m.
cases::Case with_slab(double height_m) {
  cases::Case c = quick_case();
  c.collapse.height_m = height_m;
  return c;
}

TEST(Collapse, WeighsWhatItsHeightOverHalfTheFaceAndTheCrestSays) {
  const double run = 8 / std::tan(35 * M_PI / 180);
  for (const double height : {0.3, 1.0, 2.5}) {
    const CollapseSlab s = collapse_slab(with_slab(height));
    const double volume = height * 8 * (run / 2 + 2);
    EXPECT_NEAR(s.mass_kg, 0.60 * 3215 * volume, 1e-6 * s.mass_kg);
    EXPECT_NEAR(s.face_x_m, 13 + run / 2, 1e-9);
    EXPECT_DOUBLE_EQ(s.foot_z_m, 4);
    // Room for a rock of the largest size, and for the rest looser than it settles.
    const double loose = s.top_m - 8;
    EXPECT_GT(loose, 1.7 + 2 * height);
    // Its upper side is parallel to the face.
    const double up = loose, along = s.face_x_m - s.foot_x_m;
    EXPECT_NEAR(std::atan(up / along), 35 * M_PI / 180, 1e-12);
    EXPECT_NEAR(std::atan((s.top_m - s.foot_z_m) / s.run_m), 35 * M_PI / 180, 1e-12);
  }
}

TEST(Collapse, LiesOverAScannedFaceAndBeforeAnUprightOne) {
  cases::Case c = with_slab(1);
  c.pile.profile = "scan.csv";
  // 8 m high, its upper half bulging out by a metre, then a back that falls.
  c.pile.outline_m = {{13, 0}, {19, 4}, {21, 7}, {25, 8}, {27, 6}};
  const CollapseSlab s = collapse_slab(c);
  EXPECT_DOUBLE_EQ(s.face_x_m, 19);
  EXPECT_DOUBLE_EQ(s.crest_x_m, 25);
  EXPECT_DOUBLE_EQ(s.rear_x_m, 27);
  EXPECT_NEAR(s.crest_z_m, 8 + (7 - (4 + 2 / 1.5)), 1e-9);
  EXPECT_NEAR(s.foot_z_m, s.crest_z_m - 4, 1e-9);
  EXPECT_NEAR(s.mass_kg, 0.60 * 3215 * 8 * 8, 1);

  c.pile.outline_m = {{13, 0}, {13, 8}, {20, 8}};
  const CollapseSlab upright = collapse_slab(c);
  EXPECT_LT(upright.foot_x_m, upright.face_x_m);
  EXPECT_LT(upright.face_x_m, 13);
  EXPECT_GT(upright.face_x_m, 12);
}

TEST(Collapse, ComesAtTheGivenTimeElseWhenTheDoorFirstOpens) {
  const machine::Motion motion = machine::Motion::parse(
      "time_s,hoist_m,crowd_m,swing_deg,door_deg\n"
      "0,0,0,0,0\n5,0,0,0,0\n6,0,0,0,60\n7,0,0,0,0\n20,0,0,0,0\n21,0,0,0,60\n22,0,0,0,0\n",
      "motion");
  cases::Case c = with_slab(1);
  const auto first = collapse_time_s(c, motion);
  ASSERT_TRUE(first.has_value());
  EXPECT_GT(*first, 5);
  EXPECT_LT(*first, 5.3);
  c.collapse.at_s = 12;
  EXPECT_EQ(collapse_time_s(c, motion), 12);
  c.collapse.at_s = 0;
  const machine::Motion shut = machine::Motion::parse(
      "time_s,hoist_m,crowd_m,swing_deg,door_deg\n0,0,0,0,0\n5,0,0,9,0\n6,0,0,0,0\n", "motion");
  EXPECT_FALSE(collapse_time_s(c, shut).has_value());
}

TEST(Collapse, TheDeckHasTheDefaultBenchsSlab) {
  const std::string deck = read_text(test::source() / "dem_in/collapse.in");
  for (const auto& [name, value] : collapse_variables(collapse_slab(with_slab(0.5)))) {
    std::smatch found;
    ASSERT_TRUE(
        std::regex_search(deck, found, std::regex("variable " + name + " +index ([0-9.]+)")))
        << name;
    EXPECT_NEAR(std::stod(found[1]), std::stod(value), 1e-6 * std::stod(value)) << name;
  }
}

}  // namespace
}  // namespace dipper::deck
