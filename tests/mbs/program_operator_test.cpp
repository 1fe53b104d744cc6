#include "mbs/program_operator.hpp"

#include <unistd.h>

#include <array>

#include "common/seconds.hpp"
#include "tests/mbs/shovel_fixture.hpp"

namespace dipper::mbs {
namespace {

constexpr double kLook_s = 0.1;

core::Order order(std::int64_t by_ns, double hoist, double hoist_rate) {
  return {by_ns, {hoist, 0.5, 0.2, 0, hoist_rate, 0, 0, 0}};
}

TEST(ProgramOperator, IsThereAtTheOrdersTimeWithItsRate) {
  ProgramOperator operator_({-4, 0.5, 0.2, 0});
  EXPECT_EQ(operator_.setpoint(0.3).position.hoist, -4);
  operator_.take(0.3, order(400'000'000, -4.1, -0.7));
  EXPECT_EQ(operator_.setpoint(seconds(400'000'000)).position.hoist, -4.1);
  EXPECT_EQ(operator_.setpoint(seconds(400'000'000)).rate.hoist, -0.7);
  EXPECT_EQ(operator_.setpoint(0.35).position.swing, 0.2);
  EXPECT_NEAR(operator_.setpoint(0.41).position.hoist, -4.107, 1e-12) << "it goes on at its rate";
  EXPECT_EQ(operator_.setpoint(0.41).acceleration.hoist, 0);
}

// Positions and rates of one order meet those of the next, and are each other's derivatives.
TEST(ProgramOperator, WhatItSendsIsOneCurve) {
  ProgramOperator operator_({-4, 0.5, 0.2, 0});
  const auto hoist = [&](double t_s) {
    const machine::DriveState s = operator_.setpoint(t_s);
    return std::array{s.position.hoist, s.rate.hoist, s.acceleration.hoist};
  };
  double hoist_m = -4, rate = 0.4;
  for (int k = 0; k < 5; ++k) {
    const double t_s = kLook_s * k + 0.002;  // a window late
    const auto before = hoist(t_s);
    hoist_m -= 0.05 * k;
    rate = -rate;
    operator_.take(t_s, order((k + 1) * 100'000'000, hoist_m, rate));
    const auto after = hoist(t_s);
    EXPECT_NEAR(after[0], before[0], 1e-14);
    EXPECT_NEAR(after[1], before[1], 1e-12);
    constexpr double d = 1e-5;
    for (const double at : {t_s + 0.01, t_s + 0.05, t_s + 0.09}) {
      const auto early = hoist(at - d), now = hoist(at), late = hoist(at + d);
      EXPECT_NEAR((late[0] - early[0]) / (2 * d), now[1], 1e-6);
      EXPECT_NEAR((late[1] - early[1]) / (2 * d), now[2], 1e-5);
    }
  }
}

TEST(ProgramOperator, GoesOnFromItsStateToTheBit) {
  ProgramOperator one({-4, 0.5, 0.2, 0}), other({0, 0, 0, 0});
  one.take(0.1, order(200'000'000, -4.1, -0.7));
  other.reset(0.15, one.state(0.15));
  for (const double t_s : {0.15, 0.17, 0.2, 0.23})
    EXPECT_EQ(one.setpoint(t_s).position.hoist, other.setpoint(t_s).position.hoist);
}

TEST(ProgramOperator, RefusesAnOrderThatIsLateOrOfAnotherLength) {
  ProgramOperator operator_({-4, 0.5, 0.2, 0});
  EXPECT_THROW(operator_.take(0.5, order(500'000'000, -4, 0)), std::invalid_argument);
  EXPECT_THROW(operator_.take(0.5, {600'000'000, {1, 2, 3, 4}}), std::invalid_argument);
}

class ProgramDrivenShovel : public ShovelTest {};

// An order reaches the drives, and a checkpoint in its middle goes on to the bit; a shovel that
// follows its motion takes neither.
TEST_F(ProgramDrivenShovel, TakesOrdersAndGoesOnFromACheckpoint) {
  const auto m = std::make_shared<machine::Motion>(still());
  const auto make = [&] {
    return Shovel(machine, m, Pose{}, rake, std::make_unique<ProgramOperator>(m->value(0)));
  };
  Shovel one = make(), other = make();
  core::MachineStep step{2 * kMillisecond, no_rock};
  step.order = order(100 * kMillisecond, -4.05, -0.5);
  one.step(step);
  for (int i = 2; i <= 20; ++i) one.step({2 * i * kMillisecond, no_rock});
  const auto file =
      std::filesystem::temp_directory_path() / ("program_operator" + std::to_string(getpid()));
  one.save(file);
  other.load(file);
  core::MachineState a, b;
  for (int i = 21; i <= 100; ++i) {
    a = one.step({2 * i * kMillisecond, no_rock});
    b = other.step({2 * i * kMillisecond, no_rock});
    ASSERT_EQ(a.channels, b.channels);
  }
  EXPECT_NEAR(named(one, a)["hoist"], -4.05 - 0.1 * 0.5, 0.02);
  Shovel follows(machine, still(), Pose{}, rake, kLongestSubstep_ns, machine::DriveMode::limited);
  EXPECT_THROW(follows.load(file), std::runtime_error);
  EXPECT_THROW(follows.step(step), std::runtime_error);
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace dipper::mbs
