#include "analysis/signals/phases.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace dipper::analysis::signals {
namespace {

/// One pass of 50 s: the crowd goes out from -1 to 3 m between 2 and 12 s (0.4 m/s), rests, and
/// comes in from 20 s; the swing goes to 1 rad between 15 and 25 s (0.1 rad/s), rests there until
/// 35 s and comes back at the same speed.
DriveSignals cycle(double step_s) {
  DriveSignals s;
  const auto ramp = [](double t, double t0, double t1) {
    return std::min(1.0, std::max(0.0, (t - t0) / (t1 - t0)));
  };
  for (int i = 0; i * step_s <= 50 + 1e-9; ++i) {
    const double t = i * step_s;
    s.time_s.push_back(t);
    s.crowd_m.push_back(-1 + 4 * ramp(t, 2, 12) - 4 * ramp(t, 20, 40));
    s.swing_rad.push_back(0.3 + ramp(t, 15, 25) - ramp(t, 35, 45));
  }
  return s;
}

void expect_cycle(const std::vector<Phase>& p, double within_s) {
  const char* names[] = {"approach", "penetrate", "fill", "breakout", "swing", "dump", "return"};
  const double starts[] = {0, 3, 6.5, 11.7, 15.5, 24.7, 35.3};
  ASSERT_EQ(p.size(), 7u);
  for (std::size_t k = 0; k < 7; ++k) {
    EXPECT_STREQ(word(p[k].name), names[k]);
    EXPECT_NEAR(p[k].t_start_s, starts[k], within_s) << names[k];
    EXPECT_DOUBLE_EQ(p[k].t_end_s, k < 6 ? p[k + 1].t_start_s : 50) << names[k];
  }
}

TEST(Phases, AreFoundInTheDrivenSignals) { expect_cycle(find_phases(cycle(0.01), 0, 50), 1e-9); }

TEST(Phases, ALoggersRateGivesTheSame) { expect_cycle(find_phases(cycle(1.0), 0, 50), 1e-9); }

TEST(Phases, OfASecondPassBeginWithIt) {
  DriveSignals s = cycle(0.5), again = s;
  for (std::size_t i = 1; i < again.time_s.size(); ++i) {
    s.time_s.push_back(again.time_s[i] + 50);
    s.crowd_m.push_back(again.crowd_m[i]);
    s.swing_rad.push_back(again.swing_rad[i]);
  }
  const auto p = find_phases(s, 50, 100);
  ASSERT_EQ(p.size(), 7u);
  EXPECT_NEAR(p[4].t_start_s, 65.5, 1e-9);
}

TEST(Phases, APassThatEndsWhileDiggingHasNoSwing) {
  const auto p = find_phases(cycle(0.5), 0, 14);
  ASSERT_EQ(p.size(), 4u);
  EXPECT_EQ(p[3].name, PhaseName::breakout);
  EXPECT_DOUBLE_EQ(p[3].t_end_s, 14);
}

TEST(Phases, TheCrowdMayBeFurtherOutOverTheTruck) {
  DriveSignals s = cycle(0.01);
  for (std::size_t i = 0; i < s.time_s.size(); ++i)  // 1.5 m more from 16 to 24 s, in from 36 s
    s.crowd_m[i] += 1.5 * (std::clamp((s.time_s[i] - 16) / 8, 0.0, 1.0) -
                           std::clamp((s.time_s[i] - 36) / 8, 0.0, 1.0)) +
                    4 * std::clamp((s.time_s[i] - 20) / 20, 0.0, 1.0) -
                    4 * std::clamp((s.time_s[i] - 36) / 8, 0.0, 1.0);
  ASSERT_GT(*std::max_element(s.crowd_m.begin(), s.crowd_m.end()), 4);
  expect_cycle(find_phases(s, 0, 50), 1e-9);
  EXPECT_DOUBLE_EQ(dig_heading_rad(s, 0, 50), 0.3);
}

TEST(Phases, APassMayBeginOverTheTruckWithTheCrowdOut) {
  DriveSignals s = cycle(0.01);
  for (std::size_t i = 0; i < s.time_s.size(); ++i) {  // until 1.5 s, and swings back by then
    const double left = 1 - std::clamp(s.time_s[i] / 1.5, 0.0, 1.0);
    s.crowd_m[i] += 4.2 * left;
    s.swing_rad[i] += left;
  }
  expect_cycle(find_phases(s, 0, 50), 1e-9);
}

TEST(Phases, TheHouseMayTurnBeforeTheCrowdIsAllOut) {
  DriveSignals s = cycle(0.01);
  for (std::size_t i = 0; i < s.time_s.size(); ++i)  // from 10 s on, so past 5 % at 10.5 s
    s.swing_rad[i] = 0.3 + std::clamp((s.time_s[i] - 10) / 10, 0.0, 1.0);
  const auto p = find_phases(s, 0, 34);
  ASSERT_GE(p.size(), 4U);
  EXPECT_EQ(p[1].name, PhaseName::penetrate);
  EXPECT_NEAR(p[1].t_start_s, 2.85, 0.05);
  EXPECT_NEAR(p[3].t_end_s, 10.5, 0.3);
}

TEST(Phases, TooFewReadingsAreRefused) {
  EXPECT_THROW(find_phases(cycle(1), 3.2, 3.4), std::invalid_argument);
  DriveSignals s = cycle(1);
  s.crowd_m.pop_back();
  EXPECT_THROW(find_phases(s, 0, 50), std::invalid_argument);
}

}  // namespace
}  // namespace dipper::analysis::signals
