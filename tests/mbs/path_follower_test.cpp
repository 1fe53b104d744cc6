// The drive's limits and the operator by themselves.
#include "mbs/path_follower.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mbs/drive_limit.hpp"

namespace dipper::mbs {
namespace {

TEST(LimitedDrive, GivesWhatIsWantedUpToItsStallForceAndItsPower) {
  const LimitedDrive drive({2e6, 1e6}, 0.05, 1e5);
  EXPECT_EQ(drive.most(0), 2e6);
  EXPECT_EQ(drive.most(0.5), 2e6);  // the corner
  EXPECT_EQ(drive.most(-2), 0.5e6);
  EXPECT_EQ(drive.force(3e6, 0), 2e6);
  EXPECT_EQ(drive.force(-3e6, 2), -0.5e6);
  EXPECT_EQ(drive.force(1e5, 2), 1e5);
}

// At its limit it is `lag` behind, and m x'' + C x' + K x = 0 is damped critically.
TEST(LimitedDrive, IsAsStiffAsItsLagSaysAndDampedCritically) {
  LimitedDrive drive({2e6, 1e6}, 0.05, 1e5);
  EXPECT_DOUBLE_EQ(drive.wanted(0.05, 0), 2e6);
  const double K = drive.wanted(1, 0), C = drive.wanted(0, 1);
  EXPECT_DOUBLE_EQ(C * C, 4 * K * 1e5);
  drive.set_trim(-7e5);
  EXPECT_DOUBLE_EQ(drive.wanted(0, 0), -7e5);
}

class PathFollowerTest : public testing::Test {
 protected:
  static constexpr double h = 2e-3;
  std::shared_ptr<const machine::Motion> motion = std::make_shared<machine::Motion>(
      machine::Motion::parse("time_s,hoist_m,crowd_m,swing_deg,door_deg\n"
                             "0,0,-1,0,0\n10,-5,1,60,40\n20,-5,1,60,40\n",
                             "m.csv"));
  PathFollower path{motion, -1.7};

  /// Goes on with an overload; the state after it.
  PathState go(double& t_s, double for_s, const Overload& overload) {
    const double end = t_s + for_s;
    for (; t_s < end - h / 2; t_s += h) path.ease(t_s, [&] { return overload; });
    return path.at(t_s);
  }
};

TEST_F(PathFollowerTest, KeepsTheMotionsTimeWhileTheDrivesFollow) {
  double t = 0;
  const PathState at = go(t, 5, {0.9, 1});
  EXPECT_NEAR(at.time, 5, 1e-12);
  EXPECT_EQ(at.rate, 1);
  EXPECT_EQ(at.relief, 0);
  const machine::DriveState sent = path.setpoint(t), planned = motion->at(5);
  EXPECT_NEAR(sent.position.crowd, planned.position.crowd, 1e-12);
  EXPECT_NEAR(sent.rate.hoist, planned.rate.hoist, 1e-12);
}

TEST_F(PathFollowerTest, SlowsWhereADriveIsOverloadedAndNeverGoesBack) {
  double t = 0;
  EXPECT_NEAR(go(t, 4, {0, 1.25}).rate, 0.5, 1e-6);
  double before = path.at(t).time;
  for (int i = 0; i < 50; ++i) {
    const double now = go(t, 0.1, {0, 7}).time;
    EXPECT_GE(now, before);
    before = now;
  }
  EXPECT_LT(path.at(t).rate, 1e-6);
}

// relief_rate is 0.1 m/s while the way stands; given out with about 2 s when it goes on.
TEST_F(PathFollowerTest, LetsTheCrowdBackWhereItStandsAndOutAgainWhenItGoesOn) {
  double t = 0;
  go(t, 3, {});
  const double early = go(t, 3, {0, 9}).relief;
  EXPECT_NEAR(go(t, 2, {0, 9}).relief - early, 0.2, 1e-3);
  const machine::DriveState planned = motion->at(path.at(t).time);
  EXPECT_NEAR(path.setpoint(t).position.crowd, planned.position.crowd - path.at(t).relief, 1e-12);
  go(t, 2, {});
  const double then = path.at(t).relief;
  EXPECT_NEAR(go(t, 2, {}).relief, then * std::exp(-1.0), 0.2 * then);
  go(t, 60, {0, 9});  // not beyond the crowd's stop
  EXPECT_NEAR(path.setpoint(t).position.crowd, -1.7, 0.03);
}

TEST_F(PathFollowerTest, LiftsOnWithACrowdThatStalls) {
  double t = 0;
  go(t, 3, {});
  const PathState before = path.at(t);
  const PathState after = go(t, 4, {1.45, 0.8});
  EXPECT_NEAR(after.time - before.time, 4 * 0.325, 0.2);
  EXPECT_NEAR(after.relief, 4 * 0.25, 0.06);
}

// The set point's speed is the change of its position, also while the operator slows.
TEST_F(PathFollowerTest, IsAskedForMoreBackOrSlowerButAStallCounts) {
  const auto asked = [&](const Overload& overload, const PathWish& wish) {
    PathFollower one{motion, -1.7};
    for (double t_s = 0; t_s < 1 - h / 2; t_s += h)
      one.ease(
          t_s, [&] { return overload; }, [&] { return wish; });
    return one.at(1);
  };
  EXPECT_NEAR(asked({0.5, 0.5}, {0.4, std::nullopt}).rate, 0.4, 0.01);
  EXPECT_NEAR(asked({0.5, 0.5}, {1, 0.3}).relief_rate, 0.3, 0.01);
  EXPECT_NEAR(asked({0.5, 0.5}, {1, -0.2}).relief, -0.2 * 0.8, 2e-3);
  EXPECT_NEAR(asked({1.6, 0.5}, {1, -0.2}).relief_rate, 0.5, 0.01);
  EXPECT_NEAR(asked({1.42, 0.5}, {1, 0.3}).relief_rate, 0.3, 0.01);
}

TEST_F(PathFollowerTest, WhatHeSendsIsOneCurve) {
  double t = 0;
  go(t, 4, {1.2, 0.5});
  path.ease(t, [] { return Overload{3, 3}; });
  constexpr double d = 1e-6;
  const double at = t + 1e-3;
  const machine::DriveState now = path.setpoint(at);
  for (double machine::Drives::*which : {&machine::Drives::hoist, &machine::Drives::crowd,
                                         &machine::Drives::swing, &machine::Drives::door}) {
    const double a = path.setpoint(at - d).position.*which,
                 b = path.setpoint(at + d).position.*which;
    EXPECT_NEAR((b - a) / (2 * d), now.rate.*which, 1e-7);
    const double u = path.setpoint(at - d).rate.*which, v = path.setpoint(at + d).rate.*which;
    EXPECT_NEAR((v - u) / (2 * d), now.acceleration.*which, 1e-5);
  }
}

}  // namespace
}  // namespace dipper::mbs
