#include "common/case_lines.hpp"

#include <gtest/gtest.h>

#include "common/input_error.hpp"

namespace dipper {
namespace {

TEST(CaseLines, NumbersTextsAndPlaces) {
  const CaseLines lines(
      "a.b=1.5\na.bc=[1, 2]\ntitle=\"the \\\"new\\\" face=\\\\\"\nno line\nseed=+3");
  EXPECT_EQ(lines.number("a.b"), 1.5);
  EXPECT_EQ(lines.number("seed"), 3);
  EXPECT_EQ(lines.number("a.bc"), std::nullopt);
  EXPECT_EQ(lines.number("a"), std::nullopt);
  EXPECT_EQ(lines.text("title"), "the \"new\" face=\\");
  EXPECT_EQ(lines.text("a.bc"), "[1, 2]");
  EXPECT_EQ(lines.text("none"), "");
  ASSERT_NE(lines.find("seed"), nullptr);
  EXPECT_EQ(lines.find("seed")->line, 5);
  EXPECT_EQ(lines.find("no line"), nullptr);
  EXPECT_THROW(CaseLines::read("/no/such/case.txt"), InputError);
}

}  // namespace
}  // namespace dipper
