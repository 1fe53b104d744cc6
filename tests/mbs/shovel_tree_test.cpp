// Simbody's accelerations and joint forces against the equations written out by hand, wherever the
// joints are and whatever they do.
#include "tests/mbs/shovel_tree.hpp"

#include <random>

#include "mbs/shovel_system.hpp"
#include "tests/mbs/shovel_fixture.hpp"

namespace dipper::mbs {
namespace {

TEST_F(ShovelTest, SimbodysAccelerationsAreThoseByHand) {
  std::mt19937 seed(1);
  std::uniform_real_distribution<double> any(-1, 1);
  const auto vector = [&](double scale) -> Vector3d {
    return scale * Vector3d(any(seed), any(seed), any(seed));
  };
  // Nothing symmetric about the plane of the boom, and a base that leans.
  machine.dipper.mass_center.y() = 0.3;
  machine.door.mass_center.y() = -0.2;
  machine.boom.point.y() = 0.1;
  machine.losses = {5e4, 0.05};
  const Pose base{from_rotation_vector({0.05, -0.1, 0.4}), Vector3d(-1, 2, 0.5)};
  for (const machine::DriveMode mode :
       {machine::DriveMode::prescribed, machine::DriveMode::limited}) {
    for (int i = 0; i < 50; ++i) {
      machine::DriveState to{{-3, any(seed), 2 * any(seed), 0.5 + 0.5 * any(seed)},
                             {any(seed), any(seed), any(seed), any(seed)},
                             {any(seed), any(seed), any(seed), any(seed)}};
      ShovelSystem simbody(machine, mode, base, rake, 2e-3, [&](double) { return to; });
      ShovelNumbers at;
      at.q = simbody.laws().joints(to.position);
      at.u = simbody.laws().joints(to.rate);
      at.q[kSaddle] = -0.5 + 0.4 * any(seed);
      at.u[kSaddle] = any(seed);
      const Wrenches rock{Wrench{vector(1e6), vector(1e6)}, Wrench{vector(1e5), vector(1e5)}};
      simbody.set(0, at);
      simbody.hold(rock);
      const ShovelInstant now = simbody.instant();

      const ShovelTree tree(machine, base, rake, simbody.laws().drum_inertia());
      const ShovelTree::Placement place = tree.place(at.q, at.u);
      const ShovelTree::Equations e = tree.equations(place, rock, now.loads.pull);
      const Joints force = e.force + now.loads.applied;
      EXPECT_LT((e.mass * now.acceleration - force - now.reaction).norm(), 1e-10 * force.norm())
          << i;
      EXPECT_EQ(now.reaction[kSaddle], 0);
      EXPECT_NEAR(now.kinetic, 0.5 * at.u.dot(e.mass * at.u), 1e-10 * now.kinetic);
      EXPECT_NEAR(now.potential - now.loads.potential, e.potential, 1e-9 * std::abs(e.potential));
      EXPECT_NEAR(now.rock_power, e.rock_power, 1e-10 * force.norm());
      const Joints prescribed = simbody.laws().joints(to.acceleration);
      for (const Joint j : {kSwing, kSheaves, kCrowd, kDoor}) {
        if (mode == machine::DriveMode::limited && j != kDoor) {
          EXPECT_EQ(now.reaction[j], 0) << j;
        } else {
          EXPECT_NEAR(now.acceleration[j], prescribed[j], 1e-12) << j;
        }
      }
      const auto hand = tree.bodies(place), bodies = simbody.bodies();
      for (std::size_t b = 0; b < kBodies; ++b) {
        EXPECT_LT(distance(hand[b].X_WB, bodies[b].X_WB).metres, 1e-12);
        EXPECT_LT(distance(hand[b].X_WB, bodies[b].X_WB).radians, 1e-7);
        EXPECT_LT((hand[b].V_WB_W.v - bodies[b].V_WB_W.v).norm(), 1e-12);
        EXPECT_LT((hand[b].V_WB_W.w - bodies[b].V_WB_W.w).norm(), 1e-12);
      }
    }
  }
}

}  // namespace
}  // namespace dipper::mbs
