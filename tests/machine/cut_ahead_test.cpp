#include "machine/cut_ahead.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/angles.hpp"

namespace dipper::machine {
namespace {

const Vector3d kLeft(0, 2, 0), kRight(0, -2, 0), kAhead(1, 0, 0);

/// 20 m by 12 m, with a face of this angle from x = 5 on.
HeightMap face(double deg) {
  HeightMap map(face_grid(0, 20, -6, 6));
  for (int i = 0; i < map.grid().nx; ++i)
    for (int j = 0; j < map.grid().ny; ++j)
      map.at(i, j) = std::max(0.0, map.x_of(i) - 5) * std::tan(radians(deg));
  return map;
}

Pose at(double x, double z) {
  Pose X;
  X.p = {x, 0, z};
  return X;
}

TEST(CutAhead, IsTheDepthSquareToTheFace) {
  const double deg = 30, x = 10, under_m = 1.2;
  const double surface = (x - 5) * std::tan(radians(deg));
  const CutAhead cut = cut_ahead(face(deg), at(x, surface - under_m), kLeft, kRight, kAhead);
  EXPECT_TRUE(cut.meets);
  // It looks 1.5 cells on; a cell's height is that of its middle.
  const double cell = face(deg).grid().cell_m;
  EXPECT_NEAR(cut.depth_m, (under_m + 1.5 * cell * std::tan(radians(deg))) * std::cos(radians(deg)),
              cell);
}

TEST(CutAhead, ARockThatStandsOutCountsByItsShareOfTheWidth) {
  HeightMap map = face(0);
  for (int i = 0; i < map.grid().nx; ++i)
    for (int j = 0; j < map.grid().ny; ++j)
      if (std::abs(map.y_of(j)) < 1) map.at(i, j) = 1;
  const CutAhead cut = cut_ahead(map, at(8, 0), kLeft, kRight, kAhead);
  EXPECT_NEAR(cut.depth_m, 2.0 / 4, 0.08) << "two metres of four";
}

TEST(CutAhead, MeetsNothingAboveTheFaceAtRestOrOnTheWayBack) {
  EXPECT_FALSE(cut_ahead(face(30), at(10, 9), kLeft, kRight, kAhead).meets);
  EXPECT_FALSE(cut_ahead(face(30), at(10, 1), kLeft, kRight, Vector3d::Zero()).meets);
  EXPECT_FALSE(cut_ahead(face(30), at(10, 1), kLeft, kRight, -kAhead).meets);
}

}  // namespace
}  // namespace dipper::machine
