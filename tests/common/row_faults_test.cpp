#include "common/row_faults.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dipper {
namespace {

std::vector<std::string> reported(const RowFaults& faults) {
  std::vector<Finding> findings;
  faults.report("t.csv", findings);
  std::vector<std::string> said;
  for (const Finding& finding : findings) said.push_back(to_string(finding));
  return said;
}

TEST(RowFaults, AFewAreReportedOneByOne) {
  RowFaults faults;
  EXPECT_TRUE(faults.empty());
  for (const int line : {2, 4, 9}) faults.add("x", line, 3, "x is wrong", "it must be right");
  EXPECT_FALSE(faults.empty());
  EXPECT_THAT(reported(faults), testing::ElementsAre("t.csv:2:3: x is wrong; it must be right",
                                                     "t.csv:4:3: x is wrong; it must be right",
                                                     "t.csv:9:3: x is wrong; it must be right"));
}

TEST(RowFaults, ManyOfOneKindAreOneLine) {
  RowFaults faults;
  for (int line = 2; line < 102; ++line) faults.add("x", line, 0, "x is wrong", "it must be right");
  faults.add("y", 50, 0, "y is wrong", "none");
  EXPECT_THAT(reported(faults), testing::ElementsAre("t.csv:2: x is wrong, and the same in 99 more "
                                                     "lines; it must be right",
                                                     "t.csv:50: y is wrong; none"));
}

}  // namespace
}  // namespace dipper
