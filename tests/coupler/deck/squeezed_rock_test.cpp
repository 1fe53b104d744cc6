// How long a step may be for a rock between two walls.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "coupler/deck/stable_timestep.hpp"
#include "tests/coupler/deck/liggghts_run.hpp"
#include "tests/coupler/deck/quick_case.hpp"

namespace dipper::deck {
namespace {

struct Held {
  double mean_N = 0, least_N = 0, most_N = 0;
};

/// What the plate is pressed with when it has come to stand.
Held force_on_plate(double step_s) {
  const auto out = fresh_folder("squeezed_rock");
  EXPECT_EQ(
      run_liggghts("dem_in/bench/squeezed_rock.in", fmt::format("-var step_s {}", step_s), 1, out),
      0)
      << read_text(out / "screen.txt");
  std::ifstream in(out / "force.txt");
  std::string title;
  std::getline(in, title);
  std::vector<double> force;
  for (double f = 0; in >> f;) force.push_back(f);
  EXPECT_GT(force.size(), 100U) << read_text(out / "screen.txt");
  Held held;
  for (const double f : force) held.mean_N += f / static_cast<double>(force.size());
  held.least_N = *std::min_element(force.begin(), force.end());
  held.most_N = *std::max_element(force.begin(), force.end());
  return held;
}

TEST(SqueezedRock, RestsBelowTheStepAndRattlesAbove) {
  const double limit_s = pressed_timestep(quick_case());
  const Held still = force_on_plate(0.2 * limit_s), below = force_on_plate(0.75 * limit_s),
             above = force_on_plate(1.5 * limit_s);
  EXPECT_GT(still.mean_N, 1e6);
  EXPECT_NEAR(below.most_N / below.least_N, 1, 1e-3);
  EXPECT_NEAR(below.mean_N / still.mean_N, 1, 0.02);
  // It leaves one wall and then the other, and presses harder than any squeeze has it.
  EXPECT_LT(above.least_N, 0.1 * still.mean_N);
  EXPECT_GT(above.most_N, 2 * still.mean_N);
  EXPECT_GT(above.mean_N, 1.2 * still.mean_N);
  fmt::print("{:.2f} MN at rest; {:.2f} ... {:.2f} MN, in the mean {:.2f}, above the step\n",
             1e-6 * still.mean_N, 1e-6 * above.least_N, 1e-6 * above.most_N, 1e-6 * above.mean_N);
}

}  // namespace
}  // namespace dipper::deck
