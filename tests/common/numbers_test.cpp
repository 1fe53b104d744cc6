#include "common/numbers.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace dipper {
namespace {

double number(std::string_view text) {
  double value = -99;
  EXPECT_TRUE(parse_number(text, value)) << text;
  return value;
}

TEST(Numbers, SignsPointsAndExponents) {
  EXPECT_EQ(number("1"), 1);
  EXPECT_EQ(number("+1"), 1);
  EXPECT_EQ(number("-1.5e3"), -1500);
  EXPECT_EQ(number("+.5"), 0.5);
  EXPECT_EQ(number("5."), 5);
  EXPECT_EQ(number("1E+2"), 100);
  EXPECT_EQ(number("0.1"), 0.1);
  EXPECT_EQ(number("4.9406564584124654e-324"), std::numeric_limits<double>::denorm_min());
}

TEST(Numbers, WhatIsNoNumberLeavesTheValue) {
  for (const char* text : {"",
                           " ",
                           "+",
                           "-",
                           "+-1",
                           "--1",
                           "++1",
                           ".",
                           "e5",
                           "1e",
                           "1e+",
                           " 1",
                           "1 ",
                           "1,5",
                           "1 000",
                           "0x10",
                           "nan",
                           "+nan",
                           "NaN",
                           "nan(1)",
                           "inf",
                           "-inf",
                           "infinity",
                           "1e999",
                           "1e-400",
                           "1f",
                           "1.2.3",
                           "\xEF\xBB\xBF"
                           "1"}) {
    double value = 7;
    EXPECT_FALSE(parse_number(text, value)) << text;
    EXPECT_EQ(value, 7) << text;
  }
}

TEST(Numbers, WholeOnes) {
  std::int64_t n = 7;
  for (const char* text : {"", "+", "+-1", "1.0", "1e3", "0x1", " 1", "9223372036854775808"})
    EXPECT_FALSE(parse_number(text, n)) << text;
  EXPECT_EQ(n, 7);
  EXPECT_TRUE(parse_number("+12", n));
  EXPECT_EQ(n, 12);
  EXPECT_TRUE(parse_number("-9223372036854775808", n));
  EXPECT_EQ(n, std::numeric_limits<std::int64_t>::min());
}

}  // namespace
}  // namespace dipper
