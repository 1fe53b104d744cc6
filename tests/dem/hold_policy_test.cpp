#include "dem/hold_policy.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace dipper::dem {
namespace {

using Flags = std::vector<std::uint8_t>;

TEST(WallZone, HoldsWhatIsWithinTheMarginOfTheTurnedBox) {
  const Box box{{-1, -1, -1}, {3, 1, 1}};
  Pose X_WB;
  X_WB.R = from_rotation_vector({0, 0, M_PI / 2});  // x of the body is y of the world
  X_WB.p = {10, 0, 0};
  const WallZone zone(box, X_WB, {}, 0, 0.5);
  EXPECT_TRUE(zone.holds({10, 3.4, 0}, 0));
  EXPECT_FALSE(zone.holds({10, 3.6, 0}, 0));
  EXPECT_TRUE(zone.holds({10, 3.6, 0}, 0.2)) << "a rock has a radius";
  EXPECT_FALSE(zone.holds({11.6, 0, 0}, 0));
}

TEST(WallZone, ReachesToTheCornersHoweverTheBoxIsTurned) {
  const Box box{{-1, -1, -1}, {1, 1, 1}};
  const Vector3d corner = Vector3d(1, 1, 1) * (1 + 0.5 + 0.3);  // with the margin and the radius
  Pose X_WB;
  X_WB.R = Quaterniond::FromTwoVectors(corner, Vector3d::UnitX());
  const WallZone zone(box, X_WB, {}, 0, 0.5);
  EXPECT_TRUE(zone.holds(X_WB * (0.9999 * corner), 0.3));
  EXPECT_FALSE(zone.holds(X_WB * (1.0001 * corner), 0.3));
}

TEST(WallZone, ReachesAlongTheWay) {
  const Box box{{-1, -1, -1}, {1, 1, 1}};
  const Twist V{{0, 0, 0}, {4, 0, 0}};
  const WallZone zone(box, {}, V, 2.0, 0.5);
  for (double x = 0; x <= 9.4; x += 0.1) EXPECT_TRUE(zone.holds({x, 0, 0}, 0)) << x;
  EXPECT_FALSE(zone.holds({9.6, 0, 0}, 0));
  EXPECT_FALSE(zone.holds({-1.6, 0, 0}, 0)) << "not behind";
}

TEST(Reach, AgreesWithTryingAll) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-5, 5), radius(0.1, 0.4);
  std::vector<Mover> movers;
  for (int k = 0; k < 60; ++k)
    movers.push_back({place(random), place(random), place(random), radius(random), 0.3});
  const Reach reach(movers, 0.4);
  int touched = 0;
  for (int k = 0; k < 2000; ++k) {
    const Vector3d p(place(random), place(random), place(random));
    const double r = radius(random);
    bool any = false;
    for (const Mover& m : movers)
      any = any || (Vector3d(m.x, m.y, m.z) - p).norm() < r + m.radius_m + m.gap_m;
    EXPECT_EQ(reach.touches(p, r), any);
    touched += any;
  }
  EXPECT_GT(touched, 200);
  EXPECT_LT(touched, 1800);
  EXPECT_FALSE(Reach({}, 0.4).touches({0, 0, 0}, 0.1)) << "nothing moves";

  movers.push_back({4e5, -3e5, 2e5, 0.2, 0.3});
  const Reach far(movers, 0.4);
  EXPECT_TRUE(far.touches({4e5 + 0.6, -3e5, 2e5}, 0.2)) << "one that flew off";
  for (const Mover& m : movers) EXPECT_TRUE(far.touches({m.x, m.y, m.z + 0.3}, 0.1));
  EXPECT_FALSE(far.touches({2e5, 0, 0}, 0.4));
}

TEST(HoldPolicy, HoldsWhatHasBeenCalmLongEnough) {
  setup::HoldSettings settings;
  settings.rest_s = 0.2;
  HoldPolicy policy(settings, 3);
  policy.set_flags({0, rest_flag::busy, 0});
  policy.observe(0.1);
  policy.keep_flags(0);
  EXPECT_EQ(policy.changes(policy.decide()), 0u);
  policy.flag(2, rest_flag::soon);
  policy.observe(0.11);
  policy.keep_flags(0);
  EXPECT_EQ(policy.decide(), (std::vector<Rest>{Rest::held, Rest::moving, Rest::moving}));
}

TEST(HoldPolicy, ParksOnlyWhatNothingThatMovesCanTouch) {
  std::vector<Rest> rest{Rest::moving, Rest::held, Rest::held, Rest::parked};
  HoldPolicy policy({}, rest.size());
  policy.set_flags({0, rest_flag::exposed, 0, rest_flag::exposed});
  policy.park(rest);
  EXPECT_EQ(rest, (std::vector<Rest>{Rest::moving, Rest::held, Rest::parked, Rest::held}));
}

TEST(HoldPolicy, WakesForAWallForANewLoadAndAlarmsAtOnce) {
  HoldPolicy policy({}, 2);
  policy.adopt({Rest::held, Rest::parked});
  const auto alarms = [&](const Flags& flags) {
    policy.set_flags(flags);
    return policy.alarms();
  };
  EXPECT_FALSE(alarms({0, 0}));
  EXPECT_TRUE(alarms({rest_flag::struck, 0}));
  EXPECT_FALSE(alarms({rest_flag::disturbed, 0})) << "waits for the next look";
  EXPECT_TRUE(alarms({0, rest_flag::near}));
  EXPECT_TRUE(alarms({0, rest_flag::exposed}));
  EXPECT_FALSE(alarms({rest_flag::exposed, 0})) << "held rock may be touched";

  policy.set_flags({rest_flag::disturbed, rest_flag::soon});
  EXPECT_EQ(policy.decide(), (std::vector<Rest>{Rest::moving, Rest::moving}));
}

TEST(HoldPolicy, WokenRockMustBeCalmAnew) {
  HoldPolicy policy({}, 1);
  policy.observe(1.0);
  policy.adopt({Rest::held});
  policy.observe(1.0);
  policy.adopt({Rest::moving});
  EXPECT_EQ(policy.decide()[0], Rest::moving);
}

}  // namespace
}  // namespace dipper::dem
