#include "coupler/cli/nearest_word.hpp"

#include <gtest/gtest.h>

namespace dipper::cli {
namespace {

TEST(NearestWord, IsWhatWasMeant) {
  const std::vector<std::string> known = {"check",  "run",     "replay",
                                          "report", "--ranks", "--resume"};
  EXPECT_EQ(nearest_word("chek", known), "check");
  EXPECT_EQ(nearest_word("rnu", known), "run");
  EXPECT_EQ(nearest_word("reprot", known), "report");
  EXPECT_EQ(nearest_word("--rank", known), "--ranks");
}

TEST(NearestWord, IsNoneForAWordFarFromAll) {
  EXPECT_EQ(nearest_word("simulate", {"check", "run"}), "");
  EXPECT_EQ(nearest_word("", {"run"}), "");
}

}  // namespace
}  // namespace dipper::cli
