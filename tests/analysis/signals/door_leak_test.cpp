#include "analysis/signals/door_leak.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "analysis/signals/observe.hpp"
#include "common/gravity.hpp"
#include "machine/kinematics.hpp"
#include "tests/places.hpp"

namespace dipper::analysis::signals {
namespace {

constexpr double kLoad_kg = 60e3;

struct Leak : testing::Test {
  machine::MachineData machine = machine::load_machine(test::source() / "mbs/bucyrus495.yaml");
  double rake = machine.dipper.base_rake;
  PayloadMonitor monitor{machine, rake};
  DriveSignals drives;
  PassSignals s;
  std::vector<Pass> passes = std::vector<Pass>(1);

  /// A pass of 30 s: a dig to 12 s, breakout with it; it swings from 14 to 20 s, dumps at 22 s.
  Leak() {
    const auto ramp = [](double t, double from, double to) {
      return std::clamp((t - from) / (to - from), 0.0, 1.0);
    };
    for (int k = 0; k <= 300; ++k) {
      const double t = 0.1 * k;
      drives.time_s.push_back(t);
      drives.crowd_m.push_back(-1 + 2 * ramp(t, 2, 12));
      drives.hoist_m.push_back(-6 - 5 * ramp(t, 4, 14));
      drives.swing_rad.push_back(1.2 * ramp(t, 14, 20) - 1.2 * ramp(t, 25, 30));
      drives.hoist_force_N.push_back(1e6);
      drives.crowd_force_N.push_back(2e5);
      s.dipper_mass_kg.push_back(kLoad_kg * (ramp(t, 4, 12) - ramp(t, 22, 23)));
    }
    passes[0].t_end_s = 25;
    passes[0].t_dump_s = 22;
    passes[0].dumped = true;
  }

  /// By virtual work: how much a kilogram in the dipper rises as a drive moves.
  double rise(double hoist, double crowd, double by_hoist, double by_crowd) const {
    const machine::ShovelKinematics shovel(machine, Pose{}, rake);
    const auto z = [&](double sign) {
      const double d = 1e-4 * sign;
      const machine::Drives at{hoist + d * by_hoist, crowd + d * by_crowd, 0, 0};
      return (shovel.pose(at).X_WB * Vector3d(machine.dipper.inside.x() / 2, 0, 0)).z();
    };
    return (z(1) - z(-1)) / 2e-4;
  }
};

TEST_F(Leak, AKilogramTakesWhatItsRiseDoes) {
  const auto of_a_kg = monitor.holding_of_a_kg(-10.4, 1.0);
  ASSERT_TRUE(of_a_kg);
  EXPECT_NEAR(of_a_kg->hoist, -kGravity_m_s2 * rise(-10.4, 1, 1, 0), 1e-3);
  EXPECT_NEAR(of_a_kg->crowd, kGravity_m_s2 * rise(-10.4, 1, 0, 1), 1e-3);
}

TEST_F(Leak, TakesOffWhatIsLostOnTheWay) {
  const DriveSignals whole = drives;
  leak(0.1, s, passes, monitor, drives);
  const auto lost = [&](double t) {
    const auto i = static_cast<std::size_t>(10 * t + 0.5);
    const auto of_a_kg = monitor.holding_of_a_kg(drives.hoist_m[i], drives.crowd_m[i]);
    return (whole.hoist_force_N[i] - drives.hoist_force_N[i]) / of_a_kg->hoist;
  };
  EXPECT_EQ(lost(8), 0);  // in the dig
  EXPECT_NEAR(lost(22), 0.1 * kLoad_kg, 1);
  EXPECT_NEAR(lost(20) - lost(18), lost(18) - lost(16), 1);  // in proportion to time
  EXPECT_GT(lost(16), 0);
  EXPECT_NEAR(lost(24), 0, 1);  // the dipper is empty
  EXPECT_EQ(drives.hoist_m, whole.hoist_m);
}

TEST_F(Leak, TheTruckGetsWhatIsLeft) {
  passes[0].truck_kg = kLoad_kg;
  Instruments instruments;
  instruments.door_leak = 0.1;
  EXPECT_NEAR(weigh(passes, instruments)[0].truck_mass_t, 54, 1e-9);
}

}  // namespace
}  // namespace dipper::analysis::signals
