#include "machine/swept_face.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/angles.hpp"
#include "machine/motion_plan.hpp"
#include "tests/places.hpp"

namespace dipper::machine {
namespace {

/// A dig straight along z = 1 m from x = 15 to 19 m, up, to the truck, and back; twice.
struct Level {
  MachineData data = load_machine(test::source() / "mbs/bucyrus495.yaml");
  ShovelKinematics shovel{data, Pose{}, radians(61.8)};
  Motion motion(double second_heading_rad) const {
    MotionPlan p;
    p.sample_s = 0.25;
    p.cycle_s = 40;
    p.dig = {1, 16, 2};
    p.swing_out = {16, 22, 2};
    p.door_open = {22, 23, 0.3};
    p.swing_back = {25, 31, 2};
    p.back = {25, 39, 2};
    p.door_close = {31, 33, 0.5};
    p.lift = {{19, 8}, {20, 12}};
    for (const double a : {0.0, -0.5, -0.95})  // closer to the saddle block than any dig's start
      p.lower.push_back(Vector2d(9.2, 10.8) + 11.3 * Vector2d(std::cos(a), std::sin(a)));
    p.dump_rad = 1.2;
    p.door_rad = 1.2;
    const TeethPath dig = {{15, 1}, {15.5, 1}, {17.5, 1}, {19, 1}, {19, 1}, {19, 1}};
    p.passes = {{dig, 0}, {dig, second_heading_rad}};
    return Motion::parse("time_s,hoist_m,crowd_m,swing_deg,door_deg\n" + motion_rows(p, shovel),
                         "t");
  }
  static TeethPath bench(double) { return {{0, 0}, {15.5, 0}, {15.5, 3}, {40, 3}}; }
};

TEST(SweptFace, IsWhatLiesOverTheTeeth) {
  const Level level;
  const auto passes = swept_passes(level.motion(0), level.shovel, Level::bench);
  ASSERT_EQ(passes.size(), 2U);
  EXPECT_NEAR(passes[0].area_m2, 3.5 * 2, 0.35) << "from 15.5 to 19 m, 2 m deep";
  EXPECT_NEAR(passes[0].deepest_m, 2, 0.01);
  EXPECT_NEAR(passes[1].area_m2, 0, 0.01) << "the first has been there";
  EXPECT_GT(passes[1].t_start_s, 30);
  EXPECT_LT(passes[1].t_start_s, 42);
}

TEST(SweptFace, IsWholeAgainInAnotherLane) {
  const Level level;
  const auto passes = swept_passes(level.motion(0.4), level.shovel, Level::bench);
  ASSERT_EQ(passes.size(), 2U);
  EXPECT_NEAR(passes[1].area_m2, passes[0].area_m2, 0.05);
}

TEST(SweptFace, OfADigThatIsTurnedToFirst) {
  const Level level;
  const Motion straight = level.motion(0);
  std::string rows = "0,-0.5,-1,20,0\n1,-0.5,-1,20,0\n";  // stands aside, high enough
  for (double t = 0; t <= 30; t += 0.25) {
    const Drives d = straight.at(t).position;
    rows += std::to_string(t + 6) + "," + std::to_string(d.hoist) + "," + std::to_string(d.crowd) +
            "," + std::to_string(degrees(d.swing)) + "," + std::to_string(degrees(d.door)) + "\n";
  }
  const auto passes =
      swept_passes(Motion::parse("time_s,hoist_m,crowd_m,swing_deg,door_deg\n" + rows, "t"),
                   level.shovel, [](double heading) { return Level::bench(heading); });
  ASSERT_FALSE(passes.empty());
  EXPECT_NEAR(passes[0].area_m2, 3.5 * 2, 0.35);
  EXPECT_TRUE(passes[0].first);
}

TEST(SweptFace, TeethAndTheirInverseAgree) {
  const Level level;
  const Vector2d tip(19, 4);
  EXPECT_LT((level.shovel.teeth(level.shovel.teeth_at(tip)) - tip).norm(), 1e-9);
}

}  // namespace
}  // namespace dipper::machine
