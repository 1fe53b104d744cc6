#include "analysis/signals/observe.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace dipper::analysis::signals {
namespace {

/// 10 s at uneven steps: hoist rises by 0.5 m/s, the forces are ramps of 1 and 2 kN/s.
DriveSignals ramp() {
  DriveSignals s;
  double t = 0;
  for (int i = 0; t < 10; ++i) {
    t = std::min(10.0, t + (i % 2 == 0 ? 1e-3 : 2e-3));
    s.time_s.push_back(t);
    s.hoist_m.push_back(0.5 * t);
    s.crowd_m.push_back(1);
    s.swing_rad.push_back(0.1 * t);
    s.hoist_force_N.push_back(1e3 * t);
    s.crowd_force_N.push_back(2e3 * t);
  }
  return s;
}

TEST(Observe, SamplesAreMeansOverTheirInterval) {
  Instruments instruments;
  instruments.rate_Hz = 2;
  const auto log = log_signals(ramp(), instruments);
  ASSERT_EQ(log.size(), 20U);
  for (std::size_t k = 1; k < log.size(); ++k) {  // the first begins before the first sync step
    const double middle = 0.5 * static_cast<double>(k + 1) - 0.25;
    EXPECT_DOUBLE_EQ(log[k].time_s, 0.5 * static_cast<double>(k + 1));
    EXPECT_NEAR(log[k].hoist_m, 0.5 * middle, 1e-3);
    EXPECT_NEAR(log[k].crowd_m, 1, 1e-9);
    EXPECT_NEAR(log[k].swing_rad, 0.1 * middle, 1e-3);
    EXPECT_NEAR(log[k].hoist_force_kN, middle, 2e-3);
    EXPECT_NEAR(log[k].crowd_force_kN, 2 * middle, 4e-3);
  }
}

TEST(Observe, LagMovesForcesAgainstMotion) {
  Instruments instruments;
  instruments.lag_s = 1.5;
  const auto log = log_signals(ramp(), instruments);
  const auto on_time = log_signals(ramp(), {});
  for (std::size_t k = 3; k < log.size(); ++k) {
    EXPECT_DOUBLE_EQ(log[k].hoist_m, on_time[k].hoist_m);
    EXPECT_NEAR(log[k].hoist_force_kN, on_time[k].hoist_force_kN - 1.5, 2e-3);
  }
  instruments.lag_s = -1.5;  // beyond the end the last value holds
  EXPECT_NEAR(log_signals(ramp(), instruments).back().hoist_force_kN, 10, 1e-9);
}

TEST(Observe, TheScaleReadsItsGainAndTheLastPassSpills) {
  std::vector<Pass> passes(3);
  for (int i = 0; i < 3; ++i) {
    passes[static_cast<std::size_t>(i)].pass = i + 1;
    passes[static_cast<std::size_t>(i)].truck_kg = 80e3;
    passes[static_cast<std::size_t>(i)].dumped = true;
  }
  Instruments instruments;
  instruments.scale_gain = 0.05;
  instruments.truck_spillage = 0.25;
  const auto weighed = weigh(passes, instruments);
  ASSERT_EQ(weighed.size(), 3U);
  EXPECT_NEAR(weighed[0].truck_mass_t, 84, 1e-9);
  EXPECT_NEAR(weighed[1].truck_mass_t, 84, 1e-9);
  EXPECT_NEAR(weighed[2].truck_mass_t, 63, 1e-9);
  passes.emplace_back();  // begun, but the run ends before it dumps
  ASSERT_EQ(weigh(passes, instruments).size(), 3U);
  EXPECT_NEAR(weigh(passes, instruments)[2].truck_mass_t, 63, 1e-9);
}

TEST(Observe, AnOffsetIsOfEachPassThatBroughtRock) {
  std::vector<Pass> passes(3);
  for (Pass& p : passes) p.dumped = true;
  passes[0].truck_kg = 80e3;
  passes[1].truck_kg = 2e3;
  passes[2].truck_kg = -1e3;  // slid off the truck
  Instruments instruments;
  instruments.scale_offset_t = -3;
  instruments.scale_gain = 0.1;
  const auto weighed = weigh(passes, instruments);
  EXPECT_NEAR(weighed[0].truck_mass_t, 85, 1e-9);
  EXPECT_EQ(weighed[1].truck_mass_t, 0);
  EXPECT_EQ(weighed[2].truck_mass_t, 0);
}

TEST(Observe, ACellReadsItsOwnGain) {
  Instruments instruments;
  instruments.hoist_cell_gain = 0.1;
  instruments.crowd_cell_gain = -0.2;
  const auto plain = log_signals(ramp(), {}), seen = log_signals(ramp(), instruments);
  for (std::size_t k = 0; k < plain.size(); ++k) {
    EXPECT_NEAR(seen[k].hoist_force_kN, 1.1 * plain[k].hoist_force_kN, 1e-9);
    EXPECT_NEAR(seen[k].crowd_force_kN, 0.8 * plain[k].crowd_force_kN, 1e-9);
    EXPECT_DOUBLE_EQ(seen[k].crowd_m, plain[k].crowd_m);
  }
}

TEST(Observe, RefusesSignalsOfDifferentLengths) {
  DriveSignals s = ramp();
  s.crowd_m.pop_back();
  EXPECT_THROW(log_signals(s, {}), std::invalid_argument);
  EXPECT_TRUE(log_signals({}, {}).empty());
}

}  // namespace
}  // namespace dipper::analysis::signals
