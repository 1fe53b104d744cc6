// The monitor against forces from virtual work, which knows no lever and no rope's direction.
#include "analysis/signals/payload_monitor.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/gravity.hpp"
#include "machine/kinematics.hpp"
#include "tests/places.hpp"

namespace dipper::analysis::signals {
namespace {

constexpr double kLoad_kg = 63e3;

class Monitor : public testing::Test {
 protected:
  machine::MachineData machine = machine::load_machine(test::source() / "mbs/bucyrus495.yaml");
  double rake = machine.dipper.base_rake;
  PassPhases pass;
  DriveSignals s;
  std::vector<double> door;

  /// Of weight, and of the swing's centrifugal force.
  double potential(double hoist, double crowd, double swing_rad_s) const {
    const machine::ShovelKinematics shovel(machine, Pose{}, rake);
    const machine::ShovelPose X = shovel.pose({hoist, crowd, 0, 0});
    const Vector3d out(std::cos(X.saddle), 0, std::sin(X.saddle));
    const auto of = [&](double mass, const Vector3d& p) {
      return mass * (kGravity_m_s2 * p.z() - 0.5 * std::pow(swing_rad_s * p.x(), 2));
    };
    return of(machine.handle.mass,
              X.X_WB * machine.dipper.handle_end + machine.handle.mass_center * out) +
           of(machine.dipper.mass, X.X_WB * machine.dipper.mass_center) +
           of(machine.door.mass, X.X_WD * machine.door.mass_center) +
           of(kLoad_kg, X.X_WB * Vector3d(machine.dipper.inside.x() / 2, 0, 0));
  }

  /// The forces that hold it: what a metre of rope drawn in, or of handle pushed out, takes.
  void hold(double t, double hoist, double crowd, double swing, double swing_rad_s) {
    const double d = 1e-4;
    s.time_s.push_back(t);
    s.hoist_m.push_back(hoist);
    s.crowd_m.push_back(crowd);
    s.swing_rad.push_back(swing);
    s.hoist_force_N.push_back(
        -(potential(hoist + d, crowd, swing_rad_s) - potential(hoist - d, crowd, swing_rad_s)) /
        (2 * d));
    s.crowd_force_N.push_back(
        (potential(hoist, crowd + d, swing_rad_s) - potential(hoist, crowd - d, swing_rad_s)) /
        (2 * d));
    door.push_back(0);
  }

  /// A swing from 1 s to 5 s, the door opens at 5 s; one reading every 20 ms.
  template <class Hoist>
  void swing_with(Hoist hoist, double crowd, double swing_rad_s) {
    for (int i = 0; i <= 300; ++i) {
      const double t = 0.02 * i;
      hold(t, hoist(t), crowd, swing_rad_s * t, swing_rad_s);
    }
    pass.pass.dumped = true;
    pass.pass.t_dump_s = 5;
    pass.phases = {{PhaseName::swing, 1, 4.8}};
  }
};

TEST_F(Monitor, ReadsTheLoadFromHoistAndCrowd) {
  swing_with([](double) { return -10.4; }, 1.0, 0.23);
  const auto reading = PayloadMonitor(machine, rake).weigh(s, door, pass);
  ASSERT_TRUE(reading);
  EXPECT_NEAR(reading->mass_kg, kLoad_kg, 2);
  EXPECT_TRUE(reading->at_rest);
  EXPECT_NEAR(reading->from_s, 1, 0.03);
  EXPECT_NEAR(reading->to_s, 5, 0.03);
}

// What a crowd force that is read 10 kN too high does: with the handle steep it carries the load as
// the ropes do, with the handle level it carries nothing.
TEST_F(Monitor, CountsTheCrowdByItsReading) {
  const auto off_at = [&](double hoist, double crowd) {
    s = {};
    door.clear();
    swing_with([&](double) { return hoist; }, crowd, 0);
    const PayloadMonitor monitor(machine, rake);
    EXPECT_NEAR(monitor.weigh(s, door, pass)->mass_kg, kLoad_kg, 2) << hoist;
    for (double& f : s.crowd_force_N) f += 1e4;
    return std::abs(monitor.weigh(s, door, pass)->mass_kg - kLoad_kg);
  };
  EXPECT_GT(off_at(-1.5, 0.5), 300);
  EXPECT_LT(off_at(-9.9, 1.0), 100);
}

// Until 3 s the hoist still runs, and its motor gives a tenth more: those readings do not count.
TEST_F(Monitor, WaitsUntilHoistAndCrowdStand) {
  swing_with([](double t) { return -9.0 - 0.5 * std::min(t, 3.0); }, 1.0, 0.2);
  for (std::size_t i = 0; i < s.time_s.size(); ++i)
    if (s.time_s[i] < 3) s.hoist_force_N[i] *= 1.1;
  const auto reading = PayloadMonitor(machine, rake).weigh(s, door, pass);
  ASSERT_TRUE(reading);
  EXPECT_NEAR(reading->mass_kg, kLoad_kg, 2);
  EXPECT_GT(reading->from_s, 3);
}

TEST_F(Monitor, ReadsTheWholeSwingWhereTheyNeverStand) {
  swing_with([](double t) { return -8.5 - 0.4 * t; }, 1.0, 0.2);
  const auto reading = PayloadMonitor(machine, rake).weigh(s, door, pass);
  ASSERT_TRUE(reading);
  EXPECT_FALSE(reading->at_rest);
  EXPECT_NEAR(reading->mass_kg, kLoad_kg, 2);  // at a constant speed nothing accelerates
}

TEST_F(Monitor, DoesNotWeighThroughAnOpenDoorOrWithoutASwing) {
  swing_with([](double) { return -10.4; }, 1.0, 0.2);
  const PayloadMonitor monitor(machine, rake);
  for (std::size_t i = 0; i < door.size(); ++i)
    if (s.time_s[i] > 4) door[i] = 0.01;
  EXPECT_LE(monitor.weigh(s, door, pass)->to_s, 4 + 1e-9);
  PassPhases open = pass, still = pass;
  open.pass.dumped = false;
  still.phases.clear();
  EXPECT_FALSE(monitor.weigh(s, door, open));
  EXPECT_FALSE(monitor.weigh(s, door, still));
}

}  // namespace
}  // namespace dipper::analysis::signals
