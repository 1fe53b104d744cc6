#include "common/box.hpp"

#include <gtest/gtest.h>

namespace dipper {
namespace {

const Box kBox{{1, 2, 3}, {4, 6, 8}};

TEST(Box, CornersAreAtTheFacesOfTheirBits) {
  EXPECT_EQ(kBox.corner(0), Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(kBox.corner(1), Eigen::Vector3d(4, 2, 3));
  EXPECT_EQ(kBox.corner(2), Eigen::Vector3d(1, 6, 3));
  EXPECT_EQ(kBox.corner(4), Eigen::Vector3d(1, 2, 8));
  EXPECT_EQ(kBox.corner(7), Eigen::Vector3d(4, 6, 8));
}

TEST(Box, DistanceIsBetweenTheNearestPoints) {
  EXPECT_DOUBLE_EQ(kBox.distance_m({{7, 10, 0}, {9, 11, 9}}), 5);  // 3 in x, 4 in y
  EXPECT_DOUBLE_EQ(kBox.distance_m({{-4, 2, 3}, {0, 6, 8}}), 1);
  EXPECT_DOUBLE_EQ(kBox.distance_m({{4, 5, 7}, {5, 9, 9}}), 0);
}

}  // namespace
}  // namespace dipper
