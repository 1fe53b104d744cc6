#include "common/height_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace dipper {
namespace {

/// A step at x = 10: the ground before it, a flat top of 4 m behind.
HeightMap bench() {
  HeightMap map({5, -3, 0.1, 150, 60});
  for (int i = 0; i < map.grid().nx; ++i)
    for (int j = 0; j < map.grid().ny; ++j) map.at(i, j) = map.x_of(i) > 10 ? 4 : 0;
  return map;
}

TEST(HeightMap, IsTheHighestBallOverACellsMiddle) {
  HeightMap map({0, 0, 0.5, 8, 8});
  map.add_ball({2, 2, 1}, 1);
  map.add_ball({2, 2, 0.2}, 1.2);  // wider and lower
  EXPECT_NEAR(map.height(1.75, 1.75), 1 + std::sqrt(1 - 2 * 0.25 * 0.25), 1e-12);
  EXPECT_NEAR(map.height(2.75, 2.75), 0.2 + std::sqrt(1.2 * 1.2 - 2 * 0.75 * 0.75), 1e-12);
  EXPECT_EQ(map.height(3.75, 3.75), 0) << "no ball is over it";
  EXPECT_EQ(map.height(-1, 2), 0) << "beyond the grid";
}

TEST(HeightMap, AnEdgeTakesWhatLiesAboveItsWay) {
  HeightMap map = bench();
  // A level cut 2 m under the flat top, 1 m wide: 2 m x 2 m x 1 m of rock, to a cell's breadth.
  const double x0 = 11, z = 2;
  EXPECT_NEAR(map.cut({x0, 0.5, z}, {x0, -0.5, z}, {x0 + 2, 0.5, z}, {x0 + 2, -0.5, z}), 4,
              4 * 0.25);
  EXPECT_NEAR(map.height(x0 + 1, 0), z, 1e-12);
  EXPECT_NEAR(map.height(x0 + 1, 1), 4, 1e-12) << "beside the edge nothing is cut";
  EXPECT_EQ(map.cut({x0, 0.5, z}, {x0, -0.5, z}, {x0 + 2, 0.5, z}, {x0 + 2, -0.5, z}), 0)
      << "what is gone is gone";
  EXPECT_GT(map.cut({x0, 0.5, -1}, {x0, -0.5, -1}, {x0 + 2, 0.5, -1}, {x0 + 2, -0.5, -1}), 0);
  EXPECT_EQ(map.height(x0 + 1, 0), 0) << "the ground stays";
}

TEST(HeightMap, AProfileIsTheMedianAlongAHeading) {
  HeightMap map = bench();
  map.at(20, 30) = 3;  // a rock that rolled away, at x = 7.05, y = 0.05
  const auto level = map.profile(Pose{}, 2);
  ASSERT_FALSE(level.empty());
  EXPECT_NEAR(level.front().x(), 5, HeightMap::kProfileStep_m);
  for (const auto& p : level)
    EXPECT_EQ(p.y(), p.x() > 10.05 ? 4 : p.x() < 9.95 ? 0 : p.y()) << p.x();
  Pose turned;
  turned.R = from_rotation_vector({0, 0, 0.2});
  for (const auto& p : map.profile(turned, 0.05)) {
    if (p.x() > 9.8 / std::cos(0.2)) break;
    EXPECT_EQ(p.y(), 0) << "further out along the boom";
  }
}

TEST(HeightMap, GoesThroughItsTextToACentimetre) {
  HeightMap map({1, 2, 0.5, 3, 2});
  map.at(2, 1) = 3.14159;
  const HeightMap back = height_map_from(to_json_text(map));
  EXPECT_NEAR(back.at(2, 1), 3.14, 1e-12);
  EXPECT_EQ(to_json_text(back), to_json_text(map));
  EXPECT_EQ(height_grid_from(to_json_text(map.grid())).ny, 2);
  EXPECT_THROW(height_map_from(R"({"x0_m":0,"y0_m":0,"cell_m":1,"nx":2,"ny":1,"z_cm":[1]})"),
               std::runtime_error);
  EXPECT_THROW(height_grid_from(R"({"x0_m":0,"y0_m":0,"cell_m":0,"nx":2,"ny":1})"),
               std::runtime_error);
}

TEST(HeightMap, AGridOfAnyBenchFitsAMessage) {
  for (const double side_m : {1.0, 20.0, 200.0}) {
    HeightMap map(face_grid(0, side_m, 0, side_m), 99.99);
    EXPECT_LT(to_json_text(map).size(), 60'000u) << side_m;
    EXPECT_GE(map.grid().nx * map.grid().cell_m, side_m - 1e-9);
  }
}

}  // namespace
}  // namespace dipper
