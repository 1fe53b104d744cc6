#include "analysis/signals/machine_demand.hpp"

#include <gtest/gtest.h>

#include <string>

#include "tests/places.hpp"

namespace dipper::analysis::signals {
namespace {

/// Ten seconds with the ropes as long as they are at one place; the handle is `turned` above where
/// they would hold it from 4 to 6 s.
struct Stand {
  machine::MachineData machine = machine::load_machine(test::source() / "mbs/bucyrus495.yaml");
  double rake = machine.dipper.base_rake;
  machine::ShovelKinematics shovel{machine, Pose{}, rake};
  DriveSignals s;
  std::vector<double> saddle_rad, rope_tension_N;

  explicit Stand(double turned) {
    const double hoist = -6, crowd = 1;
    for (int i = 0; i <= 100; ++i) {
      const double t = 0.1 * i;
      const bool rides = t > 3.95 && t < 6.05;
      s.time_s.push_back(t);
      s.hoist_m.push_back(hoist);
      s.crowd_m.push_back(crowd);
      saddle_rad.push_back(shovel.saddle_angle(hoist, crowd) + (rides ? turned : 0));
      s.hoist_force_N.push_back(machine.drives.hoist.stall);  // a limited motor gives no more
      rope_tension_N.push_back(t < 2.45 ? 1.01 * machine.drives.hoist.stall : 1e6);
      s.crowd_force_N.push_back(t < 4.95 ? -1.01 * machine.drives.crowd.stall : 1e6);
    }
  }
};

TEST(MachineDemand, MeasuresHowFarTheTeethAreOffAndForHowLongDrivesGiveMoreThanTheyHave) {
  const Stand stand(0.05);
  const MachineDemand demand(stand.machine, stand.rake, stand.saddle_rad);
  const Demand all = demand.over(stand.s, stand.rope_tension_N, 0, 10);
  EXPECT_NEAR(all.teeth_deviation_m, 0.05 * stand.shovel.teeth_reach(1), 1e-6);
  EXPECT_NEAR(all.hoist_beyond_fraction, 0.25, 1e-6);
  EXPECT_NEAR(all.crowd_beyond_fraction, 0.5, 1e-6) << "pulled back or pushed out";
  const Demand after = demand.over(stand.s, stand.rope_tension_N, 7, 10);
  EXPECT_NEAR(after.teeth_deviation_m, 0, 1e-6);
  EXPECT_EQ(after.hoist_beyond_fraction, 0);
  EXPECT_EQ(after.crowd_beyond_fraction, 0);
}

TEST(MachineDemand, ARopeLongerThanAnyTautOneSaysNothingOfTheTeeth) {
  Stand stand(0.05);
  for (double& hoist : stand.s.hoist_m) hoist = -100;
  EXPECT_EQ(MachineDemand(stand.machine, stand.rake, stand.saddle_rad)
                .over(stand.s, stand.rope_tension_N, 0, 10)
                .teeth_deviation_m,
            0);
}

}  // namespace
}  // namespace dipper::analysis::signals
