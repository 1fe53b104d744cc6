#include "analysis/report/thin_curve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dipper::analysis::report {
namespace {

TEST(ThinCurve, AShortCurveStaysAsItIs) {
  const std::vector<double> x = {1, 5, 2};
  EXPECT_EQ(thin_values(x, 2), x);
  EXPECT_EQ(thin_times(x, 2), x);
}

TEST(ThinCurve, KeepsEveryPeakAndItsSide) {
  std::vector<double> t, x;
  for (int i = 0; i < 10007; ++i) {
    t.push_back(0.001 * i);
    x.push_back(std::sin(0.01 * i));
  }
  x[4321] = 9;   // one row high
  x[7654] = -7;  // one row low
  const auto thin_t = thin_times(t, 100), thin_x = thin_values(x, 100);
  ASSERT_EQ(thin_x.size(), 200u);
  ASSERT_EQ(thin_t.size(), 200u);
  EXPECT_TRUE(std::is_sorted(thin_t.begin(), thin_t.end()));
  const auto high = std::max_element(thin_x.begin(), thin_x.end());
  const auto low = std::min_element(thin_x.begin(), thin_x.end());
  EXPECT_EQ(*high, 9);
  EXPECT_EQ(*low, -7);
  // Within a bin, a hundredth of the rows.
  EXPECT_NEAR(thin_t[static_cast<std::size_t>(high - thin_x.begin())], 4.321, 0.101);
  EXPECT_NEAR(thin_t[static_cast<std::size_t>(low - thin_x.begin())], 7.654, 0.101);
}

TEST(ThinCurve, WhatIsNoNumberIsPassedOver) {
  std::vector<double> x(40, std::numeric_limits<double>::quiet_NaN());
  x[25] = 3;
  const auto thin = thin_values(x, 4);
  EXPECT_TRUE(std::isnan(thin[0]));
  EXPECT_EQ(thin[4], 3);
  EXPECT_EQ(thin[5], 3);
}

}  // namespace
}  // namespace dipper::analysis::report
