// Drives with limits: stall, power, recovery, and the energy books with it all.
#include "mbs/limited_drives.hpp"

#include "common/seconds.hpp"
#include "machine/return_legs.hpp"
#include "tests/coupler/core/advance.hpp"
#include "tests/mbs/shovel_fixture.hpp"
#include "tests/mbs/wall_rock.hpp"

namespace dipper::mbs {
namespace {

class LimitedDrivesTest : public ShovelTest {
 protected:
  Shovel limited(const machine::Motion& m, std::int64_t substep_ns = kLongestSubstep_ns) {
    return Shovel(machine, m, Pose{}, rake, substep_ns, machine::DriveMode::limited);
  }
  Vector3d teeth_B() const {
    return {machine.dipper.inside.x() + machine.dipper.tooth_reach, 0,
            -machine.dipper.inside.z() / 2};
  }
  Vector3d teeth_W(Shovel& shovel) const { return shovel.state(0).bodies[0].X_WB * teeth_B(); }

  /// A wall in front of the teeth, and the two coupled as in a run.
  struct Dig {
    Dig(Shovel& shovel, const Vector3d& teeth_B, const Vector3d& at, const Vector3d& normal,
        double stiffness = 1e8)
        : machine(shovel),
          wall(teeth_B, at, normal, stiffness),
          coupling(shovel, wall, core::Scheme::corrected) {
      coupling.start();
    }
    /// The channels a window later.
    std::map<std::string, double> window(std::int64_t steps = 5) {
      const core::Window w = advance(coupling, steps);
      made += w.machine_work_J - w.rock_work_J;
      traded = std::max(traded, std::abs(work += w.rock_work_J));
      return named(machine, w.machine);
    }
    Shovel& machine;
    WallRock wall;
    core::Coupling coupling;
    double made = 0;    ///< J by the coupling
    double work = 0;    ///< J by the rock, since the start
    double traded = 0;  ///< J, its largest
  };

  static machine::Motion crowd_out() {
    return motion("0,-4,-0.5,0,0\n1,-4,-0.5,0,0\n3,-4,1,0,0\n8,-4,1,0,0\n");
  }
};

TEST_F(LimitedDrivesTest, BeginsAtRest) {
  Shovel shovel = limited(still());
  Shovel prescribed(machine, still(), Pose{}, rake);
  auto a = named(shovel, shovel.state(0)), b = named(prescribed, prescribed.state(0));
  for (const char* n : {"hoist", "crowd", "crowd_force", "rope_tension_left"})
    EXPECT_NEAR(a[n], b[n], 1e-9 * std::abs(b[n])) << n;
  EXPECT_NEAR(a["hoist_force"], b["hoist_force"], 1e-3 * b["hoist_force"]);
  const Vector3d start = shovel.state(0).bodies[0].X_WB.p;
  core::MachineState s;
  for (int i = 1; i <= 500; ++i) s = shovel.step({2 * i * kMillisecond, no_rock});
  EXPECT_LT((s.bodies[0].X_WB.p - start).norm(), 1e-9);
}

// In free air it does what prescribed drives do, in the motion's time.
TEST_F(LimitedDrivesTest, FollowsQuicksMotionWithinCentimetres) {
  const machine::Motion m = quick();
  Shovel shovel = limited(m);
  Shovel prescribed(machine, m, Pose{}, rake);
  double traded = 0;
  for (int i = 1; i <= 14'000; ++i) {
    const core::MachineState s = shovel.step({2 * i * kMillisecond, no_rock});
    const core::MachineState p = prescribed.step({2 * i * kMillisecond, no_rock});
    auto c = named(shovel, s);
    ASSERT_NEAR(c["path_time"], seconds(s.t_ns), 1e-9);
    ASSERT_EQ(c["path_rate"], 1);
    ASSERT_EQ(c["hoist_saturated"] + c["crowd_saturated"] + c["swing_saturated"], 0) << i;
    ASSERT_LT((s.bodies[0].X_WB.p - p.bodies[0].X_WB.p).norm(), 0.06) << i;
    traded = std::max(traded, std::abs(c["drive_work"]));
    ASSERT_LT(std::abs(c["energy_residual"]), 1e-5 * std::max(traded, 1e6)) << i;
  }
}

// Crowded against a wall that gives a centimetre: the crowd stalls, at its stall force and no more,
// the way stands, and is gone when the wall is.
TEST_F(LimitedDrivesTest, CrowdStallsAtAWallAndRecovers) {
  Shovel shovel = limited(crowd_out());
  Dig dig(shovel, teeth_B(), teeth_W(shovel) + Vector3d(0.5, 0, 0), Vector3d(-1, 0, 0));
  const double stall = machine.drives.crowd.stall;
  double stalled_s = 0, slowest = 1, traded = 0;
  std::map<std::string, double> c;
  for (int i = 1; i <= 9000; ++i) {  // 13.5 s
    if (i == 3600) {
      EXPECT_LT(c["path_time"], 5);
      dig.wall.take_away();
    }
    const double before = c["path_time"];
    c = dig.window();
    ASSERT_GE(c["path_time"], before);
    ASSERT_LE(std::abs(c["crowd_force"]), stall);
    if (c["crowd_saturated"] == 1) stalled_s += 1.5e-3;
    if (i < 3600) slowest = std::min(slowest, c["path_rate"]);
    traded = std::max({traded, std::abs(c["drive_work"]), dig.traded});
    ASSERT_LT(std::abs(c["energy_residual"]), 1e-4 * std::max(traded, 1e5)) << i;
  }
  EXPECT_GT(stalled_s, 1);
  EXPECT_LT(slowest, 0.6);

  EXPECT_GE(c["path_time"], 8);
  EXPECT_NEAR(c["path_rate"], 1, 1e-6);
  EXPECT_LT(c["crowd_relief"], 0.02);
  EXPECT_NEAR(c["crowd"], 1, 0.06);
  EXPECT_LT(std::abs(dig.made), 1e-3 * dig.traded);
}

// Lifted against a ceiling: the hoist stalls, at its stall force and no more.
TEST_F(LimitedDrivesTest, HoistStallsUnderACeilingAndRecovers) {
  Shovel shovel = limited(motion("0,-4,0.5,0,0\n1,-4,0.5,0,0\n3,-6,0.5,0,0\n8,-6,0.5,0,0\n"));
  Dig dig(shovel, teeth_B(), teeth_W(shovel) + Vector3d(0, 0, 0.5), Vector3d(0, 0, -1));
  double stalled_s = 0, traded = 0, most = 0;
  std::map<std::string, double> c;
  for (int i = 1; i <= 9600; ++i) {
    if (i == 2400) dig.wall.take_away();
    c = dig.window();
    most = std::max(most, c["hoist_force"]);
    if (c["hoist_saturated"] == 1) stalled_s += 1.5e-3;
    traded = std::max({traded, std::abs(c["drive_work"]), dig.traded});
    ASSERT_LT(std::abs(c["energy_residual"]), 1e-4 * std::max(traded, 1e5)) << i;
  }
  EXPECT_EQ(most, machine.drives.hoist.stall);
  EXPECT_GT(stalled_s, 1);
  EXPECT_GE(c["path_time"], 8);
  EXPECT_NEAR(c["hoist"], -6, 0.06);
  EXPECT_NEAR(c["crowd"], 0.5, 0.06);
}

TEST_F(LimitedDrivesTest, HoistKeepsToItsPowerAndComesLater) {
  machine.drives.hoist.power = 4e5;  // 0.8 MN at 0.5 m/s; the motion asks for 1 m/s
  const machine::Motion m = motion("0,-4,0.5,0,0\n1,-4,0.5,0,0\n6,-9,0.5,0,0\n8,-9,0.5,0,0\n");
  Shovel shovel = limited(m);
  double at_limit_s = 0, late_s = 0;
  std::map<std::string, double> c;
  for (int i = 1; i <= 8000; ++i) {
    const core::MachineState s = shovel.step({2 * i * kMillisecond, no_rock});
    c = named(shovel, s);
    ASSERT_LE(std::abs(c["hoist_power"]), 4e5 * (1 + 1e-12)) << i;
    if (std::abs(c["hoist_power"]) > 0.999 * 4e5) at_limit_s += 2e-3;
    late_s = std::max(late_s, seconds(s.t_ns) - c["path_time"]);
    ASSERT_LT(std::abs(c["energy_residual"]), 50) << i;
  }
  EXPECT_GT(at_limit_s, 2);
  EXPECT_GT(late_s, 1);
  EXPECT_NEAR(c["hoist"], -9, 0.02);
  EXPECT_NEAR(c["path_rate"], 1, 1e-6);
}

TEST_F(LimitedDrivesTest, SwingKeepsToItsTorque) {
  machine.drives.swing.stall = 6e6;
  const machine::Motion m = motion("0,-4,0.5,0,0\n1,-4,0.5,0,0\n6,-4,0.5,60,0\n8,-4,0.5,60,0\n");
  Shovel shovel = limited(m);
  double most = 0;
  std::map<std::string, double> c;
  for (int i = 1; i <= 12'000; ++i) {
    c = named(shovel, shovel.step({2 * i * kMillisecond, no_rock}));
    most = std::max(most, std::abs(c["swing_torque"]));
  }
  EXPECT_EQ(most, 6e6);
  EXPECT_NEAR(c["swing"], 60 * M_PI / 180, 0.002);
  EXPECT_GE(c["path_time"], 8);
}

// A blow from below that slackens the ropes: they carry nothing, which the record says, then catch.
TEST_F(LimitedDrivesTest, RopesGoSlackAndCatchWithTheBooksInOrder) {
  Shovel shovel = limited(still(), 100'000);
  const std::vector<Wrench> blow = {Wrench{Vector3d::Zero(), Vector3d(0, 0, 3e6)}, Wrench{}};
  bool slack = false, caught = false;
  for (int i = 1; i <= 1500; ++i) {
    auto c = named(shovel, shovel.step({2 * i * kMillisecond, i <= 100 ? blow : no_rock}));
    const double tension = c["rope_tension_left"] + c["rope_tension_right"];
    ASSERT_EQ(c["ropes_slack"], tension == 0 ? 1 : 0);
    if (tension == 0) slack = true;
    if (slack && tension > 6e5) caught = true;
    ASSERT_LT(std::abs(c["energy_residual"]), 1e-4 * std::max(c["interface_work"], 1e5)) << i;
  }
  EXPECT_TRUE(slack);
  EXPECT_TRUE(caught);
}

// Where the bodies meet no rock goes by the motion, and so by the path's time.
TEST_F(LimitedDrivesTest, TheWayBackIsThePathsToo) {
  machine.drives.swing.stall = 3e6;  // it comes late
  const machine::Motion m =
      motion("0,-4,0,40,50\n1,-4,0,40,50\n4,-4,-1,0,0\n6,-4,1,0,0\n8,-4,1,40,0\n9,-4,1,40,50\n");
  const auto back = machine::return_legs(m).at(0);
  for (const auto mode : {machine::DriveMode::prescribed, machine::DriveMode::limited}) {
    Shovel on(machine, m, Pose{}, rake, kLongestSubstep_ns, mode);
    Shovel off(machine, m, Pose{}, rake, kLongestSubstep_ns, mode, false);
    double late_s = 0;
    int free = 0;
    EXPECT_TRUE(off.state(0).contact);
    for (int i = 1; i <= 4000; ++i) {
      EXPECT_TRUE(on.step({2 * i * kMillisecond, no_rock}).contact);
      const core::MachineState s = off.step({2 * i * kMillisecond, no_rock});
      ASSERT_EQ(off.state(0).contact, s.contact);
      const double t_s =
          mode == machine::DriveMode::limited ? named(off, s)["path_time"] : seconds(s.t_ns);
      late_s = std::max(late_s, seconds(s.t_ns) - t_s);
      ASSERT_EQ(s.contact, t_s < seconds(back.begin_ns) || t_s >= seconds(back.end_ns)) << t_s;
      free += s.contact ? 0 : 1;
    }
    EXPECT_GT(free, 500);
    if (mode == machine::DriveMode::limited) {
      EXPECT_GT(late_s, 0.5);
    }
  }
}

// The door is sent with the rest: where the way stands so does the door.
TEST_F(LimitedDrivesTest, TheDoorKeepsThePathsTime) {
  machine.drives.swing.stall = 3e6;  // it comes late
  const machine::Motion m = motion("0,-4,0.5,0,0\n5,-4,0.5,40,50\n6,-4,0.5,40,50\n");
  Shovel shovel = limited(m);
  double late_s = 0, traded = 0;
  for (int i = 1; i <= 5000; ++i) {
    const core::MachineState s = shovel.step({2 * i * kMillisecond, no_rock});
    auto c = named(shovel, s);
    ASSERT_NEAR(c["door"], m.at(c["path_time"]).position.door, 1e-12);
    ASSERT_NEAR(c["door_rate"], m.at(c["path_time"]).rate.door * c["path_rate"], 1e-12);
    late_s = std::max(late_s, seconds(s.t_ns) - c["path_time"]);
    traded = std::max(traded, std::abs(c["drive_work"]));
    ASSERT_LT(std::abs(c["energy_residual"]), 1e-4 * std::max(traded, 1e5)) << i;
  }
  EXPECT_GT(late_s, 0.3);
}

// A crowd that can move has a finite mass against the rock: the coupling makes little energy
// against the rock's work at the window of the narrow case (docs/drives.md has other windows).
TEST_F(LimitedDrivesTest, TheCouplingMakesNoEnergyWithAFreeCrowd) {
  Shovel shovel = limited(crowd_out());
  Dig dig(shovel, teeth_B(), teeth_W(shovel) + Vector3d(0.5, 0, 0), Vector3d(-1, 0, 0), 3e7);
  for (int i = 0; i < 2000; ++i) dig.window(5);  // 3 s
  EXPECT_GT(dig.traded, 1e4);
  EXPECT_LT(std::abs(dig.made), 1e-4 * dig.traded);
}

}  // namespace
}  // namespace dipper::mbs
