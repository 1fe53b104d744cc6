#include "coupler/deck/stable_timestep.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/coupler/deck/quick_case.hpp"

namespace dipper::deck {
namespace {

/// Largest |x| over many steps of LIGGGHTS's velocity Verlet with the force of the half-step
/// velocity, for a damped spring with m = 1.
double largest(double omega, double zeta, double dt) {
  double x = 1, v = 0, f = -omega * omega, peak = 0;
  for (int i = 0; i < 4000 && peak < 1e6; ++i) {
    v += dt / 2 * f;
    x += dt * v;
    f = -omega * omega * x - 2 * zeta * omega * v;
    v += dt / 2 * f;
    peak = std::max(peak, std::abs(x));
  }
  return peak;
}

TEST(CriticalStep, IsWhereTheTwoBodyContactBlowsUp) {
  for (const double zeta : {0.0, 0.1, 0.5, 0.9, 1.0, 2.2}) {
    const double limit = critical_step(700, zeta);
    EXPECT_LT(largest(700, zeta, 0.995 * limit), 10) << zeta;
    EXPECT_GT(largest(700, zeta, 1.005 * limit), 1e5) << zeta;
  }
  EXPECT_NEAR(critical_step(1, 0), 2, 1e-15);
  EXPECT_NEAR(critical_step(1, 0.9), 0.8907, 1e-4);
}

TEST(StableTimestep, AgreesWithThePapersStep) {
  cases::Case c = quick_case();
  c.rock.coarse_graining = 1;
  c.rock.density_kg_m3 = 3700;
  c.contact.normal_scale = 0.05;
  // 4.5e-5 s at sqrt(m/K_n) = 4.1e-4 s: the paper's step is inside the bound.
  EXPECT_GT(stable_timestep(c), 4.5e-5);
  EXPECT_LT(stable_timestep(c), 2 * 4.5e-5);
  EXPECT_NEAR(stable_timestep(c), 0.183 * 4.067e-4, 0.001 * 4.067e-4);
}

TEST(StableTimestep, ScalesWithSizeAndStiffness) {
  const double step = stable_timestep(quick_case());
  cases::Case c = quick_case();
  c.rock.coarse_graining *= 2;
  EXPECT_NEAR(stable_timestep(c) / step, 2, 1e-9);
  c = quick_case();
  c.contact.normal_scale *= 4;
  EXPECT_NEAR(stable_timestep(c) / step, 0.5, 1e-9);
  c = quick_case();
  c.contact.normal_damping = c.contact.tangential_damping = 0.1;
  EXPECT_GT(stable_timestep(c), 2 * step);
}

TEST(StableTimestep, FallsWhereTangentialSpringsOrDampersAreStrong) {
  const double step = stable_timestep(quick_case());
  cases::Case c = quick_case();
  c.contact.tangential_damping_other = 1;  // the paper's
  EXPECT_DOUBLE_EQ(stable_timestep(c), step);
  c.contact.tangential_damping = c.contact.tangential_damping_other.emplace(3);
  EXPECT_NEAR(stable_timestep(c) / step, 0.37, 0.01);
  c = quick_case();
  c.contact.tangential_scale = 3;
  EXPECT_NEAR(stable_timestep(c) / step, 0.42, 0.01);
  for (auto* friction : {&c.contact.friction_sphere_sphere, &c.contact.friction_sphere_rock,
                         &c.contact.friction_rock_rock, &c.contact.friction_dipper,
                         &c.contact.friction_ground, &c.contact.friction_truck})
    *friction = 0;  // nothing turns a rock
  EXPECT_DOUBLE_EQ(stable_timestep(c), step);
}

}  // namespace
}  // namespace dipper::deck
