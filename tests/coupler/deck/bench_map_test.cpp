// The bench as the case makes it, as a map of heights.
#include "coupler/deck/bench_map.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/angles.hpp"
#include "coupler/case/bench_surface.hpp"
#include "tests/coupler/deck/height_field.hpp"
#include "tests/coupler/deck/quick_case.hpp"

namespace dipper::deck {
namespace {

TEST(BenchMap, RisesFromTheToeToTheCrestAndHasTheBenchsWidth) {
  const cases::Case c = quick_case();  // toe at 13 m, 8 m high, 8 m wide, 35 degrees
  const HeightMap map = bench_map(c);
  const double slope = std::tan(radians(35)), cell = map.grid().cell_m;
  for (const double y : {-3.9, 0.0, 3.9}) {
    EXPECT_EQ(map.height(12.9, y), 0);
    EXPECT_NEAR(map.height(15, y), 2 * slope, cell * slope);
    EXPECT_NEAR(map.height(20, y), 7 * slope, cell * slope);
    EXPECT_NEAR(map.height(13 + 8 / slope + 1, y), 8, 1e-9) << "behind the crest";
  }
  EXPECT_EQ(map.height(20, 4.1), 0) << "beside the bench";
  EXPECT_EQ(map.height(13 + 8 / slope + c.pile.crest_depth_m + 0.2, 0), 0) << "behind it";
}

TEST(BenchMap, OfAScanIsTheScan) {
  cases::Case c = quick_case();
  const auto wanted = [](double x, double y) { return 0.8 + (x - 13) * (0.45 + 0.05 * y); };
  c.pile.profile = "scan.stl";
  c.pile.surface = std::make_shared<cases::BenchSurface>(
      height_field({12.5, 15, 17}, {-4.5, -1, 2, 4.5}, wanted));
  c.pile.outline_m = c.pile.surface->section(4, 1);
  const HeightMap map = bench_map(c);
  for (int i = 3; i + 3 < map.grid().nx; ++i)
    for (const int j : {2, map.grid().ny / 2, map.grid().ny - 3})
      ASSERT_NEAR(map.at(i, j), c.pile.surface->height(map.x_of(i), map.y_of(j)), 1e-12);
  EXPECT_GT(map.height(16, 3), map.height(16, -3) + 0.5) << "it is twisted";
}

}  // namespace
}  // namespace dipper::deck
