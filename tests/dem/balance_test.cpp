// The returned wrenches are what the rock received: its momentum balances, window by window.
//
// Velocity Verlet adds f dt / 2 before and after each step's new positions, so over a window of n
// steps from step 0, exactly but for rounding,
//
//   P_n - P_0 = dt (f_0/2 + f_1 + ... + f_{n-1} + f_n/2) + M g n dt,
//
// with f the walls' force on all rock (what grain does to grain cancels). The sum is n times the
// trapezoidal mean over the window: with the returned F (of the rock, on the bodies), H = n dt,
//
//   P_n - P_0 = -H (sum over bodies of F) + M g H.
//
// The drum is closed, so no other wall takes part.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/dem/drum.hpp"
#include "tests/dem/momentum.hpp"

namespace dipper::dem {
namespace {

const Vector3d gravity(0, 0, -9.81);

class Balance : public testing::TestWithParam<const char*> {};

TEST_P(Balance, OfMomentumOverAWindow) {
  constexpr int steps = 10, windows = 600;
  test::Drum drum(GetParam());
  const double window = steps * drum.timestep();
  drum.rock().place(test::Drum::poses(0));
  drum.rock().step({steps, test::Drum::poses(window)});  // inserts the rock
  test::Momentum before = test::momentum(drum.rock().liggghts());
  ASSERT_GT(before.mass, 500);
  ASSERT_GE(before.bodies, std::string(GetParam()) == "multispheres" ? 20 : 0);

  double worst = 0, largest = 0;
  int loaded = 0;
  for (int k = 2; k <= windows; ++k) {
    const core::RockState state = drum.rock().step({steps, test::Drum::poses(k * window)});
    const test::Momentum after = test::momentum(drum.rock().liggghts());
    ASSERT_NEAR(after.mass, before.mass, 1e-9) << "rock left the drum in window " << k;
    const Vector3d F = state.bodies[0].mean.force + state.bodies[1].mean.force;
    const Vector3d received = after.linear - before.linear - after.mass * gravity * window;
    // The floor is the rock's weight: without contact there is no force to be relative to.
    const double scale = std::max(F.norm(), after.mass * gravity.norm()) * window;
    worst = std::max(worst, (received + F * window).norm() / scale);
    largest = std::max(largest, F.norm());
    loaded += state.bodies[0].mean.force.norm() > 0 && state.bodies[1].mean.force.norm() > 0;
    before = after;
  }
  if (test::rank() == 0) {
    fmt::print("{}: {:.0f} kg, {} bodies, momentum balance off by {:.2e}; largest force {:.3g} N\n",
               GetParam(), before.mass, before.bodies, worst, largest);
  }
  EXPECT_GT(loaded, windows / 4) << "windows in which both bodies felt the rock";
  EXPECT_LT(worst, 1e-8);   // the requirement
  EXPECT_LT(worst, 1e-11);  // the regression
}

INSTANTIATE_TEST_SUITE_P(Rock, Balance, testing::Values("spheres", "multispheres"),
                         [](const auto& kind) { return std::string(kind.param); });

}  // namespace
}  // namespace dipper::dem
