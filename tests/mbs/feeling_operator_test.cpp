// The operator who feels the dig, with a machine that holds given loads at rest.
#include "mbs/feeling_operator.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/mbs/shovel_fixture.hpp"

namespace dipper::mbs {
namespace {

constexpr double kFull_kg = 80e3;
constexpr double h = 1e-3;

class FeelingOperatorTest : public ShovelTest {
 protected:
  /// Teeth 7 m up, lifting slowly.
  std::shared_ptr<const machine::Motion> way =
      std::make_shared<machine::Motion>(motion("0,-5,1,0,0\n50,-5.5,1,0,0\n"));
  FeelingOperator one{way, machine, rake, kFull_kg};
  machine::HandleStatics statics{machine, rake};
  const machine::Drives at{-5, 1, 0, 0};

  /// Held at rest. \param share  of the pull that this takes, that the ropes have
  Felt held(double load_kg, double resistance_N, double share = 1, double overload = 0.5) const {
    const machine::HandlePlace p = statics.at(at);
    const machine::Holding by =
        p.holding(p.empty() + load_kg * p.of_a_kg() + resistance_N * p.of_a_newton());
    Felt f;
    f.drives.position = at;
    f.motors.hoist = {-share * by.hoist, 4.8e6, -share * by.hoist, 0, 0};
    f.motors.crowd = {overload * 3e6, 3e6, by.crowd, 0.1, 0.1};
    f.motors.swing = {0, 1, 0, 0, 0};
    return f;
  }

  static void go(FeelingOperator& who, double from_s, double to_s, const Felt& felt) {
    for (double t = from_s; t < to_s - h / 2; t += h) who.update(t, [&] { return felt; });
  }

  /// Path time, rate, relief, its rate, lift, its rate, load, whether it has landed.
  static double number(const FeelingOperator& who, double t_s, std::size_t i) {
    return who.state(t_s).at(i);
  }
};

TEST_F(FeelingOperatorTest, WeighsWithATimeConstantAndNotWhileTheCrowdStalls) {
  go(one, 0, 0.5, held(40e3, 1e6));
  EXPECT_NEAR(number(one, 0.5, 6), 40e3 * (1 - std::exp(-1)), 50);
  go(one, 0.5, 5, held(40e3, 1e6));
  EXPECT_NEAR(number(one, 5, 6), 40e3, 10);
  go(one, 5, 7, held(-60e3, 1e6, 1, 1.2));
  EXPECT_NEAR(number(one, 7, 6), 40e3, 10);
}

TEST_F(FeelingOperatorTest, GoesDeeperWhileTheDipperIsLightByAtMostSixTenths) {
  go(one, 0, 2, held(40e3, 1e6));
  EXPECT_NEAR(number(one, 2, 2), -0.2 * (2 - 0.2), 2e-3) << "0.2 m/s, after the reaction";
  go(one, 2, 12, held(40e3, 1e6));
  EXPECT_NEAR(number(one, 12, 2), -0.6, 0.05);
  EXPECT_NEAR(one.setpoint(12).position.crowd, 1 - number(one, 12, 2), 1e-12);
  go(one, 12, 16, held(40e3, 0));  // the face has ended: 2 s for an e-th
  EXPECT_NEAR(number(one, 16, 2), -0.6 * std::exp(-2), 0.03);
}

TEST_F(FeelingOperatorTest, BreaksOutWhenFullAndStaysOut) {
  go(one, 0, 6, held(90e3, 1e6));  // felt full after 0.5 s ln 9 = 1.1 s; deeper before
  const double back = number(one, 6, 2);
  EXPECT_GT(back, 1);
  go(one, 6, 9, held(90e3, 0));
  EXPECT_NEAR(number(one, 9, 2), back, 0.07) << "within the reaction time";
}

TEST_F(FeelingOperatorTest, FreesWhatIsCaughtAndGivesBack) {
  go(one, 0, 3, held(0, 0, 0.3));
  EXPECT_NEAR(number(one, 3, 4), 0.3 * (3 - 0.2), 3e-3);
  EXPECT_NEAR(number(one, 3, 2), 0.3 * (3 - 0.2), 3e-3);
  EXPECT_NEAR(number(one, 3, 1), 0.25, 1e-3);
  const machine::DriveState sent = one.setpoint(3), planned = way->at(number(one, 3, 0));
  EXPECT_NEAR(sent.position.hoist, planned.position.hoist - number(one, 3, 4), 1e-12);
  go(one, 3, 15, held(0, 0, 0.3));
  EXPECT_NEAR(number(one, 15, 4), 3, 0.07) << "no more than that";
  go(one, 15, 19, held(0, 0));
  EXPECT_NEAR(number(one, 19, 4), 3 * std::exp(-2), 0.05);
  EXPECT_NEAR(number(one, 19, 1), 0.25, 1e-3) << "until the crowd is out again";
  EXPECT_LT(number(one, 19, 2), number(one, 15, 2) - 0.5 * 3.5);
}

/// Comes down for 10 s, then stands.
TEST_F(FeelingOperatorTest, KeepsTheRopeOfADipperThatHasLanded) {
  FeelingOperator down{
      std::make_shared<machine::Motion>(motion("0,-5.5,1,0,0\n10,-4.5,1,0,0\n30,-4.5,1,0,0\n")),
      machine, rake, kFull_kg};
  go(down, 4, 6, held(0, 0, 0.3));
  const double lift = number(down, 6, 4);
  EXPECT_GT(lift, 0.3);
  go(down, 6, 18, held(0, 0));
  EXPECT_GE(number(down, 18, 4), lift - 0.05) << "it hangs, and the lift does not decay";
  FeelingOperator other{way, machine, rake, kFull_kg};
  other.reset(18, down.state(18));
  EXPECT_EQ(other.state(18), down.state(18));
}

TEST_F(FeelingOperatorTest, GoesOnFromItsStateToTheBit) {
  go(one, 0, 2, held(40e3, 1e6));
  FeelingOperator other{way, machine, rake, kFull_kg};
  other.reset(2, one.state(2));
  one.reset(2, one.state(2));
  for (FeelingOperator* each : {&one, &other}) {
    go(*each, 2, 3, held(0, 0, 0.2));
    go(*each, 3, 4, held(95e3, 1e6, 1, 1.3));
  }
  EXPECT_EQ(one.state(4), other.state(4));
}

/// What is sent has no jump of position or rate.
TEST_F(FeelingOperatorTest, TheSetpointIsOneCurve) {
  double t = 0;
  machine::DriveState last = one.setpoint(0);
  for (int i = 0; i < 6000; ++i, t += h) {
    const double load = i < 2000 ? 30e3 : 95e3, share = i % 3000 < 2500 ? 1 : 0.1;
    one.update(t, [&] { return held(load, 1e6, share); });
    const machine::DriveState now = one.setpoint(t);
    EXPECT_LT(std::abs(now.position.hoist - last.position.hoist), 1e-3);
    EXPECT_LT(std::abs(now.rate.hoist - last.rate.hoist), 0.01);
    EXPECT_LT(std::abs(now.rate.crowd - last.rate.crowd), 0.01);
    last = now;
  }
}

}  // namespace
}  // namespace dipper::mbs
