#include "analysis/signals/pass_phases.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace dipper::analysis::signals {
namespace {

double ramp(double t, double t0, double t1) {
  return std::min(1.0, std::max(0.0, (t - t0) / (t1 - t0)));
}

/// One pass of 40 s: crowd out from 2 to 12 s, swing from 15 to 25 s, dump at 26 s. Penetrate
/// begins at 3 s, breakout ends at 15.5 s. The ropes are slack from 4 to 6.5 s: a fifth of the 12.5
/// s.
struct Cycle {
  PassSignals pass;
  DriveSignals drive;
  Cycle() {
    for (int i = 0; i <= 4000; ++i) {
      const double t = 0.01 * i;
      const bool slack = t >= 4 - 1e-9 && t < 6.5 - 1e-9;
      pass.time_s.push_back(t);
      pass.door_rad.push_back(ramp(t, 26, 27) - ramp(t, 30, 31));
      pass.dipper_force_N.push_back(t > 3 ? 1e6 : 0);
      pass.hoist_force_N.push_back(slack ? 0 : 3e6);
      pass.rope_tension_N.push_back(slack ? 0 : 3e6);
      pass.crowd_force_N.push_back(4e6);
      pass.dipper_mass_kg.push_back(8e4 * (ramp(t, 4, 12) - ramp(t, 26, 27)));
      pass.truck_mass_kg.push_back(8e4 * ramp(t, 26, 28));
      drive.crowd_m.push_back(-1 + 4 * ramp(t, 2, 12) - 4 * ramp(t, 28, 38));
      drive.swing_rad.push_back(ramp(t, 15, 25) - ramp(t, 30, 38));
    }
    drive.time_s = pass.time_s;
  }
};

TEST(PassPhases, TellTheDigsForceAndWhatPartOfItTheRopesAreSlack) {
  const Cycle cycle;
  const auto passes = find_pass_phases(cycle.pass, cycle.drive);
  ASSERT_EQ(passes.size(), 1U);
  const PassPhases& p = passes[0];
  ASSERT_TRUE(p.dig());
  EXPECT_NEAR(p.dig()->t_start_s, 3, 1e-6);
  EXPECT_NEAR(p.dig()->t_end_s, 15.5, 1e-6);
  ASSERT_TRUE(p.dig_slack_fraction);
  EXPECT_NEAR(*p.dig_slack_fraction, 0.2, 1e-6);
  EXPECT_NEAR(*p.dig_phases_force_mean_N, 0.8 * 5e6 + 0.2 * 4e6, 10);
  EXPECT_NEAR(slack_fraction(cycle.pass, 4, 9), 0.5, 1e-6);
  EXPECT_EQ(slack_fraction(cycle.pass, 100, 200), 0) << "nothing there";
}

TEST(PassPhases, APassThatDoesNotSwingEndsItsDigWithTheDump) {
  Cycle cycle;
  for (double& swing : cycle.drive.swing_rad) swing = 0.2;
  const auto passes = find_pass_phases(cycle.pass, cycle.drive);
  ASSERT_EQ(passes.size(), 1U);
  ASSERT_TRUE(passes[0].dig());
  EXPECT_DOUBLE_EQ(passes[0].dig()->t_end_s, passes[0].pass.t_dump_s);
  EXPECT_EQ(passes[0].phases.back().name, PhaseName::dump);
  EXPECT_DOUBLE_EQ(passes[0].phases.back().t_end_s, 40);
}

TEST(PassPhases, APassThatMetNoRockHasNoDigForce) {
  Cycle cycle;
  for (double& force : cycle.pass.dipper_force_N) force = 0;
  const auto passes = find_pass_phases(cycle.pass, cycle.drive);
  ASSERT_EQ(passes.size(), 1U);
  EXPECT_FALSE(passes[0].dig_phases_force_mean_N);
  EXPECT_FALSE(passes[0].dig_slack_fraction);
}

/// A run may end at any sync step: with one row of a phase, two rows of a pass.
TEST(PassPhases, ARunThatEndsAnywhereHasPhasesUpToItsEnd) {
  for (std::size_t n = 2; n <= 4001; n += n < 20 ? 1 : 17) {
    Cycle cycle;
    for (auto* v :
         {&cycle.pass.time_s, &cycle.pass.door_rad, &cycle.pass.dipper_force_N,
          &cycle.pass.hoist_force_N, &cycle.pass.crowd_force_N, &cycle.pass.rope_tension_N,
          &cycle.pass.dipper_mass_kg, &cycle.pass.truck_mass_kg, &cycle.drive.time_s,
          &cycle.drive.crowd_m, &cycle.drive.swing_rad})
      v->resize(n);
    const auto passes = find_pass_phases(cycle.pass, cycle.drive);
    ASSERT_EQ(passes.size(), 1U) << n;
    ASSERT_FALSE(passes[0].phases.empty()) << n;
    double from = 0;
    for (const Phase& phase : passes[0].phases) {
      EXPECT_NEAR(phase.t_start_s, from, 1e-9) << n;
      EXPECT_GT(phase.t_end_s, from) << n;
      EXPECT_TRUE(std::isfinite(slack_fraction(cycle.pass, from, phase.t_end_s))) << n;
      from = phase.t_end_s;
    }
    EXPECT_NEAR(from, cycle.pass.time_s.back(), 1e-9) << n;
    EXPECT_TRUE(std::isfinite(passes[0].dig_phases_force_mean_N.value_or(0))) << n;
  }
}

TEST(PassPhases, APassWhoseDoorHasNotOpenedHasNoDump) {
  Cycle cycle;
  for (double& door : cycle.pass.door_rad) door = 0;
  const auto passes = find_pass_phases(cycle.pass, cycle.drive);
  ASSERT_EQ(passes.size(), 1U);
  EXPECT_EQ(passes[0].phases.back().name, PhaseName::swing);
  EXPECT_NEAR(passes[0].phases.back().t_end_s, 40, 1e-9);
}

/// A motor with limits accelerates its drum, with or without a pull in the ropes.
TEST(PassPhases, RopesAreSlackWhateverTheHoistDrivePulls) {
  Cycle cycle;
  for (double& f : cycle.pass.hoist_force_N) f = std::max(f, 9e4);
  EXPECT_NEAR(*find_pass_phases(cycle.pass, cycle.drive).at(0).dig_slack_fraction, 0.2, 1e-6);
}

TEST(PassPhases, ADipperOnItsRopesIsNotSlack) {
  Cycle cycle;
  for (double& f : cycle.pass.rope_tension_N) f = std::max(f, 5e5);
  EXPECT_EQ(find_pass_phases(cycle.pass, cycle.drive).at(0).dig_slack_fraction, 0.0);
}

}  // namespace
}  // namespace dipper::analysis::signals
