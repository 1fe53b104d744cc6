// Forces at rest and in prescribed motion, against balances worked by hand.
#include <gmock/gmock.h>

#include "machine/sheave_path.hpp"
#include "tests/mbs/shovel_fixture.hpp"

namespace dipper::mbs {
namespace {

constexpr double kG = 9.81;

struct HandBalance {
  double weight;      ///< N, of what hangs on the saddle beyond the block
  double moment;      ///< N m about the saddle, gravity, negative turns the handle down
  Vector3d rope_W;    ///< unit vector along the ropes at the bail
  double arm;         ///< m, of the ropes' force about the saddle
  Vector3d handle_W;  ///< unit vector along the handle
};

HandBalance balance(const machine::MachineData& m, const machine::ShovelKinematics& k,
                    const machine::Drives& d, double saddle) {
  const machine::ShovelPose X = k.pose(d, saddle);
  const Vector3d p_WS = m.saddle.position;
  HandBalance b{};
  b.handle_W = Vector3d(std::cos(saddle), 0, std::sin(saddle));
  const Vector3d p_WE = X.X_WB * m.dipper.handle_end;
  const auto hang = [&](double mass, const Vector3d& p_W) {
    b.weight += mass * kG;
    b.moment -= mass * kG * (p_W - p_WS).x();
  };
  hang(m.handle.mass, p_WE + m.handle.mass_center * b.handle_W);
  hang(m.dipper.mass, X.X_WB * m.dipper.mass_center);
  hang(m.door.mass, X.X_WD * m.door.mass_center);
  const Vector3d p_WL = X.X_WB * m.dipper.bail;
  const Vector3d to_bail = p_WL - m.boom.point;
  const Vector3d to_drum = m.rope.drum - m.boom.point;
  const machine::SheavePath path = machine::sheave_path(
      {to_drum.x(), to_drum.z()}, {to_bail.x(), to_bail.z()}, m.boom.sheave_radius);
  b.rope_W = Vector3d(path.toward_b.x(), 0, path.toward_b.y());
  // About -y, so that lifting is positive.
  b.arm = (p_WL - p_WS).x() * b.rope_W.z() - (p_WL - p_WS).z() * b.rope_W.x();
  return b;
}

TEST_F(ShovelTest, StartsInStaticBalance) {
  for (const char* rows : {"0,0,-1.5,0,0\n1,0,-1.5,0,0\n", "0,-4,0.5,30,0\n1,-4,0.5,30,0\n",
                           "0,-6,3,0,0\n1,-6,3,0,0\n", "0,-9,-1,-45,0\n1,-9,-1,-45,0\n",
                           "0,-10.5,1,0,60\n1,-10.5,1,0,60\n"}) {
    Shovel shovel(machine, motion(rows), Pose{}, rake);
    auto c = named(shovel, shovel.state(0));
    const machine::Drives flat{c["hoist"], c["crowd"], 0,
                               c["door"]};  // the balance does not depend on swing
    const HandBalance b = balance(machine, {machine, Pose{}, rake}, flat, c["saddle_pitch"]);
    const double tension = -b.moment / b.arm;
    EXPECT_NEAR(c["rope_tension_left"] + c["rope_tension_right"], tension, 1e-6 * tension);
    EXPECT_DOUBLE_EQ(c["rope_tension_left"], c["rope_tension_right"]);
    EXPECT_NEAR(c["hoist_force"], tension, 1e-6 * tension);
    // Along the handle: crowd + ropes + weight = 0.
    const double crowd = b.weight * b.handle_W.z() - tension * b.rope_W.dot(b.handle_W);
    EXPECT_NEAR(c["crowd_force"], crowd, 1e-6 * b.weight);
    EXPECT_NEAR(c["swing_torque"], 0, 1e-3);
    // The door's weight about its hinge.
    const machine::ShovelKinematics k(machine, Pose{}, rake);
    const machine::ShovelPose X = k.pose(flat, c["saddle_pitch"]);
    const Vector3d p = X.X_WD * machine.door.mass_center - X.X_WD.p;
    EXPECT_NEAR(c["door_torque"], -machine.door.mass * kG * p.x(), 1e-6 * machine.door.mass * kG);
  }
}

TEST_F(ShovelTest, NothingBouncesAtTheStart) {
  Shovel shovel(machine, still(), Pose{}, rake);
  const Vector3d start = shovel.state(0).bodies[0].X_WB.p;
  core::MachineState s;
  for (int i = 1; i <= 500; ++i) s = shovel.step({2 * i * kMillisecond, no_rock});
  EXPECT_LT((s.bodies[0].X_WB.p - start).norm(), 1e-9);
  EXPECT_LT(s.bodies[0].V_WB_W.v.norm(), 1e-9);
}

// Crowding out at a constant acceleration with the handle level: force = m a along the handle, plus
// the ropes' and gravity's component, plus what the turning handle needs (here none at t -> 0+).
TEST_F(ShovelTest, CrowdReactionIsMassTimesAccelerationPlusWeight) {
  // x = t^2/2 (1 - ...) starts with c2 > 0: read the acceleration off the motion itself.
  const machine::Motion m = motion("0,-4,0.5,0,0\n1,-4,0.9,0,0\n2,-4,1.3,0,0\n");
  const double a = m.at(0.0).acceleration.crowd;
  ASSERT_GT(a, 0.5);
  Shovel shovel(machine, m, Pose{}, rake);
  auto c = named(shovel, shovel.state(0));
  const machine::Drives d{c["hoist"], c["crowd"], 0, 0};
  const HandBalance b = balance(machine, {machine, Pose{}, rake}, d, c["saddle_pitch"]);
  const double tension = -b.moment / b.arm;
  const double statics = b.weight * b.handle_W.z() - tension * b.rope_W.dot(b.handle_W);
  // Everything on the slider turns about the saddle with alpha, which the crowd's inertia force
  // excites; both follow from the 2 x 2 mass matrix in (angle, crowd).
  const machine::ShovelKinematics k(machine, Pose{}, rake);
  const machine::ShovelPose X = k.pose(d, c["saddle_pitch"]);
  const Vector3d p_WE = X.X_WB * machine.dipper.handle_end;
  struct Part {
    double mass;
    Vector3d p;
    double inertia;
  };
  const std::vector<Part> parts = {
      {machine.handle.mass, p_WE + machine.handle.mass_center * b.handle_W,
       machine.handle.inertia.y()},
      {machine.dipper.mass, X.X_WB * machine.dipper.mass_center, machine.dipper.inertia.y()},
      {machine.door.mass, X.X_WD * machine.door.mass_center, machine.door.inertia.y()}};
  double mass = 0, inertia = machine.saddle.inertia, cross = 0;
  for (const Part& part : parts) {
    const Vector3d r = part.p - machine.saddle.position;
    mass += part.mass;
    inertia += part.inertia + part.mass * r.squaredNorm();
    cross += part.mass * Vector3d(-r.z(), 0, r.x()).dot(b.handle_W);  // mass (dv/dangle . handle)
  }
  const double alpha = -cross * a / inertia;
  EXPECT_NEAR(c["crowd_force"], statics + mass * a + cross * alpha, 1e-6 * mass * kG);
}

// Virtual work: a wrench that pulls straight down the handle is carried by the crowd alone but for
// its lever on the ropes.
TEST_F(ShovelTest, AWrenchShowsInRopeTensionAndCrowdForce) {
  const double damping = machine.saddle.damping;
  machine.saddle.damping = 5e7;  // settle soon
  Shovel shovel(machine, still(), Pose{}, rake);
  auto before = named(shovel, shovel.state(0));
  const Vector3d force(-2.0e5, 0, -3.0e5);
  const Vector3d at_B(4.6, 0, -1.5);  // on the teeth
  core::MachineState s = shovel.state(0);
  for (int i = 1; i <= 4000; ++i) {
    const Vector3d lever = s.bodies[0].X_WB.R * at_B;
    s = shovel.step({2 * i * kMillisecond, {Wrench{lever.cross(force), force}, Wrench{}}});
  }
  auto c = named(shovel, s);
  EXPECT_LT(std::abs(c["saddle_rate"]), 1e-9);
  const machine::Drives d{c["hoist"], c["crowd"], 0, 0};
  HandBalance b = balance(machine, {machine, Pose{}, rake}, d, c["saddle_pitch"]);
  const Vector3d r = s.bodies[0].X_WB * at_B - machine.saddle.position;
  const double tension = -(b.moment + r.x() * force.z() - r.z() * force.x()) / b.arm;
  EXPECT_NEAR(c["hoist_force"], tension, 1e-5 * tension);
  EXPECT_GT(tension, before["hoist_force"] + 1e5);
  const double crowd =
      b.weight * b.handle_W.z() - tension * b.rope_W.dot(b.handle_W) - force.dot(b.handle_W);
  EXPECT_NEAR(c["crowd_force"], crowd, 1e-5 * b.weight);
  machine.saddle.damping = damping;
}

// Ropes a thousand times stiffer: the same poses as the rigid-rope kinematics.
TEST_F(ShovelTest, AgreesWithTheRigidRopeKinematics) {
  machine.rope.axial_stiffness *= 1000;
  machine.rope.damping *= 30;
  const machine::Motion m = quick();
  const Pose base{from_rotation_vector({0, 0, 0.1}), Vector3d(-0.5, 0.2, 0.1)};
  const machine::ShovelKinematics rigid(machine, base, rake);
  Shovel shovel(machine, m, base, rake, 500'000);
  for (std::int64_t t = 10; t <= 27'000; t += 10) {
    const core::MachineState s = shovel.step({t * kMillisecond, no_rock});
    const machine::ShovelPose X = rigid.pose(m.value(s.t_ns));
    const PoseDistance body = distance(s.bodies[0].X_WB, X.X_WB);
    const PoseDistance door = distance(s.bodies[1].X_WB, X.X_WD);
    ASSERT_LT(body.metres, 1e-4) << t;
    ASSERT_LT(body.radians, 1e-5) << t;
    ASSERT_LT(door.metres, 1e-4) << t;
    ASSERT_LT(door.radians, 1e-5) << t;
  }
}

// With the real ropes the bail hangs lower by their stretch, no more.
TEST_F(ShovelTest, RealRopesStretchByCentimetres) {
  const machine::Motion m = quick();
  const machine::ShovelKinematics rigid(machine, Pose{}, rake);
  Shovel shovel(machine, m, Pose{}, rake);
  for (std::int64_t t = 10; t <= 27'000; t += 10) {
    const core::MachineState s = shovel.step({t * kMillisecond, no_rock});
    auto c = named(shovel, s);
    const double stretch = c["rope_tension_left"] * machine.rope.elastic_fraction *
                           (machine.rope.length_at_zero_hoist + c["hoist"]) /
                           machine.rope.axial_stiffness;
    const double moved = (s.bodies[0].X_WB.p - rigid.pose(m.value(s.t_ns)).X_WB.p).norm();
    ASSERT_LT(moved, 1.6 * stretch + 0.002) << t;
  }
}

}  // namespace
}  // namespace dipper::mbs
