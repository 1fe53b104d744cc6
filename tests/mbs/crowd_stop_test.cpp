// A crowd that is pushed beyond its motor's force comes to its stop and no further.
#include "tests/mbs/shovel_fixture.hpp"

namespace dipper::mbs {
namespace {

TEST_F(ShovelTest, TheCrowdEndsAtItsStops) {
  for (const double side : {-1.0, 1.0}) {
    Shovel shovel(machine, still(), Pose{}, rake, kLongestSubstep_ns, machine::DriveMode::limited);
    auto c = named(shovel, shovel.state(0));
    double traded = 0, beyond = 0;
    for (int i = 1; i <= 3000; ++i) {
      const double pitch = c["saddle_pitch"];
      // Along the handle, half as much again as its motor gives, and then let go.
      const double push = i <= 2500 ? side * 1.5 * machine.drives.crowd.stall : 0;
      const Vector3d force = push * Vector3d(std::cos(pitch), 0, std::sin(pitch));
      // Through the handle's end, so that it does not turn the dipper.
      const Vector3d end =
          Eigen::AngleAxisd(-pitch - rake, Vector3d::UnitY()) * machine.dipper.handle_end;
      c = named(shovel,
                shovel.step({2 * i * kMillisecond, {Wrench{end.cross(force), force}, Wrench{}}}));
      traded = std::max({traded, std::abs(c["drive_work"]), std::abs(c["interface_work"])});
      ASSERT_LT(std::abs(c["energy_residual"]), 1e-3 * std::max(traded, 1e5)) << i;
      beyond = std::max(
          {beyond, c["crowd"] - machine.limits.crowd_max, machine.limits.crowd_min - c["crowd"]});
    }
    EXPECT_GT(beyond, 1e-3) << "it was there";
    EXPECT_LT(beyond, 0.2) << "three megajoules in a buffer that takes 12 kJ at the stall force";
    EXPECT_LT(c["crowd"], machine.limits.crowd_max);
    EXPECT_GT(c["crowd"], machine.limits.crowd_min);
  }
}

}  // namespace
}  // namespace dipper::mbs
