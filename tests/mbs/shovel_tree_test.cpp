// The equations written out against Simbody's, wherever the joints are and whatever they do.
#include "mbs/shovel_tree.hpp"

#include <random>

#include "mbs/shovel_dynamics.hpp"
#include "mbs/shovel_model.hpp"
#include "tests/mbs/shovel_fixture.hpp"

namespace dipper::mbs {
namespace {

TEST_F(ShovelTest, TheEquationsWrittenOutAreSimbodys) {
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
    const ShovelDynamics dynamics(machine, mode, base, rake);
    ShovelModel simbody(machine, base, rake, dynamics.drum_inertia());
    for (int i = 0; i < 50; ++i) {
      Joints q, u;
      q << 2 * any(seed), -3, -0.5 + 0.4 * any(seed), any(seed), 0.5 + 0.5 * any(seed);
      for (int j = 0; j < kJoints; ++j) u[j] = any(seed);
      machine::DriveState sent;
      sent.acceleration = {any(seed), any(seed), any(seed), any(seed)};
      const Wrenches rock{Wrench{vector(1e6), vector(1e6)}, Wrench{vector(1e5), vector(1e5)}};
      const Instant now = dynamics.at(q, u, {}, sent, rock);
      const Joints simbodys =
          simbody.reactions(q, u, now.acceleration, now.applied, rock, now.pull);
      EXPECT_LT((simbodys - now.reaction).norm(), 1e-11 * now.force.norm()) << i;
      EXPECT_EQ(now.reaction[kSaddle], 0);
    }
  }
}

}  // namespace
}  // namespace dipper::mbs
