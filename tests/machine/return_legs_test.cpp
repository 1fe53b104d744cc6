#include "machine/return_legs.hpp"

#include <gtest/gtest.h>

#include <string>

#include "common/seconds.hpp"

namespace dipper::machine {
namespace {

Motion motion(const std::string& rows) {
  return Motion::parse("time_s,hoist_m,crowd_m,swing_deg,door_deg\n" + rows, "test");
}

TEST(ReturnLegs, FromTheDoorThatClosesToTheCrowdThatIsIn) {
  const auto legs = return_legs(
      motion("0,0,-1,0,0\n2,0,-1,0,0\n8,-4,2,0,0\n14,-8,1,60,0\n16,-8,1,60,70\n20,-8,1,50,70\n"
             "23,-6,0,10,0\n28,0,-1,0,0\n30,0,-1,0,0\n36,-4,2,0,0\n42,-8,1,60,0\n44,-8,1,60,70\n"
             "48,-8,1,40,70\n50,-8,1,30,0\n60,0,-1,0,0\n"));
  ASSERT_EQ(legs.size(), 2U);
  EXPECT_NEAR(seconds(legs[0].begin_ns), 20, 0.02);
  // The crowd begins to move at 30 s; it has gone out by 1 mm a little later.
  EXPECT_NEAR(seconds(legs[0].end_ns), 30.05, 0.1);
  EXPECT_NEAR(seconds(legs[1].begin_ns), 48, 0.02);
  EXPECT_EQ(legs[1].end_ns, 60'000'000'000) << "no dig follows";
}

TEST(ReturnLegs, ADoorThatOpensLittleTheSecondTimeIsOpenAllTheSame) {
  const auto legs = return_legs(
      motion("0,0,-1,0,0\n8,-4,2,0,0\n14,-8,1,60,0\n16,-8,1,60,70\n20,-8,1,50,70\n23,-6,0,10,0\n"
             "30,0,-1,0,0\n36,-4,2,0,0\n42,-8,1,60,0\n44,-8,1,60,20\n48,-8,1,40,20\n50,-8,1,30,0\n"
             "60,0,-1,0,0\n"));
  ASSERT_EQ(legs.size(), 2U);
  EXPECT_NEAR(seconds(legs[1].begin_ns), 48, 0.02);
}

TEST(ReturnLegs, NoneWhileTheDoorStaysOpenOrShut) {
  EXPECT_TRUE(return_legs(motion("0,0,-1,0,0\n8,-4,2,0,0\n")).empty());
  EXPECT_TRUE(return_legs(motion("0,0,-1,0,0\n8,-4,2,0,0\n9,-4,2,0,70\n12,-4,2,0,70\n")).empty());
}

}  // namespace
}  // namespace dipper::machine
