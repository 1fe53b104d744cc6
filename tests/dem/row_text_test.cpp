#include "dem/row_text.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace dipper::dem {
namespace {

TEST(RowText, DigitsGoByTheSmallestSphere) {
  const std::vector<double> row = {7, 1.23456789, -0.04321, 0.00004, -0.0004, 1.2346, 12.346, 0.2};
  const std::vector<std::string> columns = {"id", "x", "y", "z", "vx", "vy", "omegaz", "radius"};
  EXPECT_EQ(RowText(columns, 0.2).of(row), "7 1.2346 -0.0432 0 0 1.235 12.35 0.2\n");
  EXPECT_EQ(RowText(columns, 0.05).of(row), "7 1.2346 -0.0432 0 0 1.235 12.35 0.2\n");
  EXPECT_EQ(RowText(columns, 0.001).of(row),
            "7 1.234568 -0.04321 0.00004 -0.0004 1.2346 12.35 0.2\n");
  EXPECT_EQ(RowText(columns, 1000).of(row), "7 1 0 0 0 1 12.346 0.2\n");
}

TEST(RowText, WholeNumbersAndWhatIsNoNumber) {
  const RowText text({"id", "id_multisphere", "x", "density"}, 0.1);
  EXPECT_EQ(text.of({12345678, -1, 1e18, 2600.5}), "12345678 -1 1e+18 2600.5\n");
  EXPECT_EQ(text.of({1, 2, std::nan(""), 1.0 / 3}), "1 2 nan 0.333333\n");
  EXPECT_EQ(text.of({1, 2, -120, 1e-7}), "1 2 -120 1e-07\n");
  EXPECT_EQ(text.of({}), "");
}

TEST(RowText, RowsComeByTheirId) {
  EXPECT_EQ(RowText({"x", "id"}, 0.1).of({0.5, 9, 0.25, 3}), "0.25 3\n0.5 9\n");
  EXPECT_EQ(RowText({"x", "radius"}, 0.1).of({0.5, 9, 0.25, 3}), "0.5 9\n0.25 3\n");
}

}  // namespace
}  // namespace dipper::dem
