#include "machine/face_scan.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace dipper::machine {
namespace {

/// A face of 45 degrees from x = 5 on, up to 5 m, with an upright drop behind its crest at x = 12.
HeightMap face() {
  HeightMap map({0, 0, 0.2, 100, 20});
  for (int i = 0; i < map.grid().nx; ++i)
    for (int j = 0; j < map.grid().ny; ++j) {
      const double x = map.x_of(i);
      map.at(i, j) = x < 5 || x > 12 ? 0 : std::min(5.0, x - 5);
    }
  return map;
}

TEST(FaceScan, IsTheFaceItselfWithoutErrors) {
  EXPECT_EQ(scanned(face(), {0, 2, 6}, {}, 1).heights(), face().heights());
}

TEST(FaceScan, HasTheErrorThatIsStatedAndTheSameForASeed) {
  const ScanErrors errors{0.3, 0};
  const HeightMap flat({0, 0, 0.2, 100, 100}, 10);
  const HeightMap seen = scanned(flat, {0, 0, 20}, errors, 7);
  double sum = 0, square = 0;
  for (const double z : seen.heights()) {
    sum += z - 10;
    square += (z - 10) * (z - 10);
  }
  const auto n = static_cast<double>(seen.heights().size());
  EXPECT_NEAR(sum / n, 0, 4 * 0.3 / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(square / n), 0.3, 0.01);
  EXPECT_EQ(scanned(flat, {0, 0, 20}, errors, 7).heights(), seen.heights());
  EXPECT_NE(scanned(flat, {0, 0, 20}, errors, 8).heights(), seen.heights());
}

TEST(FaceScan, WhatIsHiddenOrMetTooFlatIsPutInFromBesideIt) {
  // From 6 m up the top, 5 m, is met at less than 20 degrees, and hides what is behind the crest.
  const HeightMap seen = scanned(face(), {0, 2, 6}, {0, 0.35}, 1);
  EXPECT_NEAR(seen.height(7, 2), face().height(7, 2), 1e-12) << "the face is seen";
  EXPECT_GT(seen.height(13, 2), 3) << "not the ground behind the crest";
  EXPECT_GT(seen.height(11, 2), 3) << "the top, from the face's upper end";
  // From above all is seen.
  EXPECT_EQ(scanned(face(), {8, 2, 100}, {0, 0.35}, 1).height(13, 2), 0);
}

}  // namespace
}  // namespace dipper::machine
