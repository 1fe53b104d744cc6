// The machine's energy books.
#include "tests/mbs/shovel_fixture.hpp"

namespace dipper::mbs {
namespace {

// A free swing of the saddle on undamped ropes: pushed for 0.2 s, then left alone.
TEST_F(ShovelTest, FreeSwingConservesEnergy) {
  machine.saddle.damping = 0;
  machine.rope.damping = 0;
  // Half the longest step: the integrator's third order loses an eighth as much.
  Shovel shovel(machine, still(), Pose{}, rake, kLongestSubstep_ns / 2);
  const std::vector<Wrench> push = {Wrench{Vector3d::Zero(), Vector3d(0, 0, 4e5)}, Wrench{}};
  core::MachineState s = shovel.step({200 * kMillisecond, push});
  auto c = named(shovel, s);
  const double start = c["kinetic_energy"] + c["potential_energy"];
  double least = c["kinetic_energy"], most = least;
  for (int i = 101; i <= 5000; ++i) {
    c = named(shovel, shovel.step({2 * i * kMillisecond, no_rock}));
    least = std::min(least, c["kinetic_energy"]);
    most = std::max(most, c["kinetic_energy"]);
    ASSERT_NEAR(c["kinetic_energy"] + c["potential_energy"], start, 1e-4 * most) << i;
  }
  EXPECT_LT(least, 0.01 * most);  // it did swing
  EXPECT_GT(most, 1e3);
}

// Drives + rock - damping = change of energy, over the whole of the narrow case with a rough load.
TEST_F(ShovelTest, PowersBalanceOverACycle) {
  const machine::Motion m = quick();
  Shovel shovel(machine, m, Pose{}, rake);
  std::map<std::string, double> c;
  double traded = 0;
  for (int i = 1; i <= 14'000; ++i) {
    const double t = 2e-3 * i;
    const Wrench dig{Vector3d(1e5 * std::sin(3 * t), -4e5, 2e5 * std::cos(5 * t)),
                     Vector3d(-4e5 * std::sin(t / 4), 5e4 * std::sin(7 * t), -5e5)};
    const Wrench door{Vector3d(0, 2e4, 0), Vector3d(-3e4, 0, -5e4)};
    c = named(shovel, shovel.step({2 * i * kMillisecond, {dig, door}}));
    traded = std::max({traded, std::abs(c["drive_work"]), std::abs(c["interface_work"])});
    ASSERT_LT(std::abs(c["energy_residual"]), 1e-6 * std::max(traded, 1e5)) << t;
  }
  EXPECT_GT(traded, 1e6);
}

// The powers of the channels are those the works are made of.
TEST_F(ShovelTest, PowersOfTheChannelsAreTheRatesOfTheWorks) {
  const machine::Motion m = quick();
  Shovel shovel(machine, m, Pose{}, rake);
  const std::vector<Wrench> F = {Wrench{Vector3d(0, -1e5, 0), Vector3d(-2e5, 0, -3e5)}, Wrench{}};
  std::map<std::string, double> a, b = named(shovel, shovel.step({5'100 * kMillisecond, F}));
  for (int i = 1; i <= 50; ++i) {
    a = b;
    b = named(shovel, shovel.step({(5'100 + i) * kMillisecond, F}));
    const auto drives = [](std::map<std::string, double>& c) {
      return c["hoist_power"] + c["crowd_power"] + c["swing_power"] + c["door_power"];
    };
    EXPECT_NEAR(b["drive_work"] - a["drive_work"], 0.5e-3 * (drives(a) + drives(b)),
                1e-3 * std::abs(drives(a)) * 1e-3 + 0.5);
    EXPECT_NEAR(b["interface_work"] - a["interface_work"],
                0.5e-3 * (a["interface_power"] + b["interface_power"]), 0.5);
    EXPECT_NEAR(b["dissipated_energy"] - a["dissipated_energy"],
                0.5e-3 * (a["dissipated_power"] + b["dissipated_power"]), 0.05);
  }
}

// A blow from below that slackens the ropes: they carry nothing, then catch the dipper again.
TEST_F(ShovelTest, RopesGoSlackAndCatchWithTheBooksInOrder) {
  Shovel shovel(machine, still(), Pose{}, rake, 100'000);
  const std::vector<Wrench> blow = {Wrench{Vector3d::Zero(), Vector3d(0, 0, 3e6)}, Wrench{}};
  bool slack = false, caught = false;
  for (int i = 1; i <= 2000; ++i) {
    auto c = named(shovel, shovel.step({2 * i * kMillisecond, i <= 100 ? blow : no_rock}));
    const double tension = c["rope_tension_left"];
    ASSERT_GE(tension, 0);
    if (tension == 0) slack = true;
    if (slack && tension > 3e5) caught = true;
    ASSERT_LT(std::abs(c["energy_residual"]), 1e-4 * std::max(c["interface_work"], 1e5)) << i;
  }
  EXPECT_TRUE(slack);
  EXPECT_TRUE(caught);
}

}  // namespace
}  // namespace dipper::mbs
