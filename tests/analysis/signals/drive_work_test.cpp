#include "analysis/signals/drive_work.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace dipper::analysis::signals {
namespace {

/// 10 s at 10 Hz: hoist power rises by 1 MW a second, the crowd gives 0.5 MW, the swing brakes.
DriveSignals signals() {
  DriveSignals s;
  for (int i = 0; i <= 100; ++i) {
    s.time_s.push_back(0.1 * i);
    s.hoist_power_W.push_back(1e5 * i);
    s.crowd_power_W.push_back(5e5);
    s.swing_power_W.push_back(-2e5);
  }
  return s;
}

TEST(DrivesWork, IsThePowersIntegral) {
  const DrivesWork w = drives_work(signals(), 2, 6);
  EXPECT_NEAR(w.hoist.work_J, 16e6, 1e-3);
  EXPECT_NEAR(w.hoist.power_mean_W, 4e6, 1e-3);
  EXPECT_NEAR(w.hoist.power_peak_W, 6e6, 1e-3);
  EXPECT_NEAR(w.crowd.work_J, 2e6, 1e-3);
  EXPECT_NEAR(w.swing.work_J, -8e5, 1e-3);
  EXPECT_NEAR(w.swing.power_peak_W, -2e5, 1e-3) << "a drive that brakes puts nothing in";
  EXPECT_NEAR(drives_work(signals(), 2.01, 2.05).hoist.work_J, 2.05e6 * 0.04, 1e-3)
      << "its share of the work between two readings";
  DriveSignals without = signals();
  without.crowd_power_W.clear();
  EXPECT_THROW(drives_work(without, 2, 6), std::invalid_argument);
}

TEST(DigEnergy, IsHoistAndCrowdFromPenetrateToBreakoutByThePayload) {
  PassPhases pass;
  pass.phases = {{PhaseName::approach, 0, 2},
                 {PhaseName::penetrate, 2, 3},
                 {PhaseName::fill, 3, 5},
                 {PhaseName::breakout, 5, 6}};
  pass.phases.push_back({PhaseName::swing, 6, 9});
  auto e = dig_energy(signals(), pass);
  ASSERT_TRUE(e);
  EXPECT_NEAR(e->work_J, 18e6, 1e-3);
  EXPECT_FALSE(e->specific_J_kg) << "nothing is loaded";
  pass.pass.payload_kg = 60e3;
  EXPECT_NEAR(*dig_energy(signals(), pass)->specific_J_kg, 300, 1e-6);
  pass.phases = {{PhaseName::swing, 6, 9}};
  EXPECT_FALSE(dig_energy(signals(), pass));
}

}  // namespace
}  // namespace dipper::analysis::signals
