// Friction, losses, rope stretch and stuck mass change the drives' forces as their laws say.
#include "machine/machine_condition.hpp"

#include "tests/mbs/shovel_fixture.hpp"
#include "tests/places.hpp"

namespace dipper::mbs {
namespace {

class MachineConditionTest : public ShovelTest {
 protected:
  /// The machine without a swing or a door: crowd out at 0.4 m/s and back, hoist in and out.
  static machine::Motion crowd_out_and_back() {
    return motion("0,-4,0,0,0\n1,-4,0,0,0\n3,-4,0.8,0,0\n5,-4,0,0,0\n6,-4,0,0,0\n");
  }
  static machine::Motion hoist_in_and_out() {
    return motion("0,-4,0.5,0,0\n1,-4,0.5,0,0\n3,-5,0.5,0,0\n5,-4,0.5,0,0\n6,-4,0.5,0,0\n");
  }

  /// Drives' channels of the machine as it is and in a condition, at the same times.
  void compare(const machine::Motion& m, const machine::MachineCondition& condition,
               const std::function<void(double t, std::map<std::string, double>&,
                                        std::map<std::string, double>&)>& look) {
    Shovel plain(machine, m, Pose{}, rake);
    Shovel worn(machine::in_condition(machine, condition), m, Pose{}, rake);
    for (int i = 1; i <= 300; ++i) {
      auto a = named(plain, plain.step({20 * i * kMillisecond, no_rock}));
      auto b = named(worn, worn.step({20 * i * kMillisecond, no_rock}));
      look(0.02 * i, a, b);
      ASSERT_LT(std::abs(b["energy_residual"]), 1.0) << i;
    }
  }
};

TEST_F(MachineConditionTest, CrowdFrictionAddsItselfAgainstTheCrowdsMotion) {
  machine::MachineCondition c;
  c.crowd_friction_N = 6e4;
  double out = 0, back = 0;
  compare(crowd_out_and_back(), c, [&](double t, auto& a, auto& b) {
    const double more = b["crowd_force"] - a["crowd_force"];
    EXPECT_NEAR(more, 6e4 * std::tanh(a["crowd_rate"] / 0.02), 1.0) << t;
    EXPECT_NEAR(b["hoist_force"], a["hoist_force"], 1e-3 * a["hoist_force"]) << t;
    out = std::max(out, more);
    back = std::min(back, more);
  });
  EXPECT_NEAR(out, 6e4, 10);
  EXPECT_NEAR(back, -6e4, 10);
}

TEST_F(MachineConditionTest, HoistLossRaisesTheWinchsForceHaulingInAndLowersItPayingOut) {
  machine::MachineCondition c;
  c.hoist_loss = 0.05;
  double in = 0, out = 0;
  compare(hoist_in_and_out(), c, [&](double t, auto& a, auto& b) {
    const double tension = a["rope_tension_left"] + a["rope_tension_right"];
    const double more = (b["hoist_force"] - a["hoist_force"]) / tension;
    EXPECT_NEAR(more, -0.05 * std::tanh(a["hoist_rate"] / 0.02), 1e-6) << t;
    in = std::max(in, more);
    out = std::min(out, more);
  });
  EXPECT_NEAR(in, 0.05, 1e-4);
  EXPECT_NEAR(out, -0.05, 1e-4);
}

// Two ropes of stiffness k = EA / (f L) carry T each: they stretch by T / k.
TEST_F(MachineConditionTest, RopesOfTwiceTheComplianceStretchTwiceAsFar) {
  machine::MachineCondition c;
  c.rope_compliance = 2;
  Shovel plain(machine, still(), Pose{}, rake);
  Shovel worn(machine::in_condition(machine, c), still(), Pose{}, rake);
  auto a = named(plain, plain.state(0)), b = named(worn, worn.state(0));
  const machine::ShovelKinematics rigid(machine, Pose{}, rake);
  const double unloaded = rigid.saddle_angle(-4, 0.5);
  EXPECT_NEAR((b["saddle_pitch"] - unloaded) / (a["saddle_pitch"] - unloaded), 2, 0.02);
}

// Virtual work: at rest the hoist force changes by m g times dz/dl of the mass.
TEST_F(MachineConditionTest, StuckMassHangsOnTheRopes) {
  machine::MachineCondition c;
  c.added_mass_kg = 5000;
  c.added_center_m = machine.dipper.mass_center;
  Shovel plain(machine, still(), Pose{}, rake);
  Shovel worn(machine::in_condition(machine, c), still(), Pose{}, rake);
  auto a = named(plain, plain.state(0)), b = named(worn, worn.state(0));
  // The same as a rock of that weight hung at the same place.
  const core::MachineState s = plain.state(0);
  const Pose& X_WB = s.bodies[0].X_WB;
  const Vector3d at = X_WB.R * machine.dipper.mass_center;
  const Vector3d weight(0, 0, -5000 * 9.81);
  auto hung = plain.step({kMillisecond, {Wrench{at.cross(weight), weight}, Wrench{}}});
  for (int i = 2; i <= 4000; ++i) {
    hung = plain.step({5 * i * kMillisecond, {Wrench{at.cross(weight), weight}, Wrench{}}});
  }
  const double rock = named(plain, hung)["hoist_force"] - a["hoist_force"];
  EXPECT_NEAR(b["hoist_force"] - a["hoist_force"], rock, 0.01 * rock);
  EXPECT_GT(rock, 2e4);
}

TEST(MachineCondition, AddedMassMovesTheCentreAndAddsItsInertia) {
  machine::MachineData m = machine::load_machine(test::source() / "mbs/bucyrus495.yaml");
  m.rope.axial_stiffness = 1;
  m.dipper.mass = 3;
  m.dipper.mass_center = {1, 0, 0};
  m.dipper.inertia = {1, 2, 3};
  machine::MachineCondition c;
  c.added_mass_kg = 1;
  c.added_center_m = {5, 0, 0};
  c.added_inertia_kg_m2 = {0.1, 0.2, 0.3};
  const machine::MachineData d = machine::in_condition(m, c);
  EXPECT_DOUBLE_EQ(d.dipper.mass, 4);
  EXPECT_TRUE(d.dipper.mass_center.isApprox(Vector3d(2, 0, 0)));
  // 3 (2 - 1)^2 + 1 (5 - 2)^2 = 12 about y and z.
  EXPECT_TRUE(d.dipper.inertia.isApprox(Vector3d(1.1, 14.2, 15.3)));
}

}  // namespace
}  // namespace dipper::mbs
