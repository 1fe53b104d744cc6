#include "common/nearest_word.hpp"

#include <gtest/gtest.h>

namespace dipper {
namespace {

TEST(NearestWord, EditDistance) {
  EXPECT_EQ(edit_distance("size", "size"), 0U);
  EXPECT_EQ(edit_distance("Size", "size"), 0U);
  EXPECT_EQ(edit_distance("sise", "size"), 1U);
  EXPECT_EQ(edit_distance("szie", "size"), 1U);
  EXPECT_EQ(edit_distance("siz", "size"), 1U);
  EXPECT_EQ(edit_distance("", "size"), 4U);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
}

TEST(NearestWord, IsWhatWasMeant) {
  const std::vector<std::string> known = {"check",  "run",     "replay",
                                          "report", "--ranks", "--resume"};
  EXPECT_EQ(nearest_word("chek", known), "check");
  EXPECT_EQ(nearest_word("rnu", known), "run");
  EXPECT_EQ(nearest_word("rnaks", {"timestep_s", "ranks"}), "ranks");
  EXPECT_EQ(nearest_word("reprot", known), "report");
  EXPECT_EQ(nearest_word("--rank", known), "--ranks");
}

TEST(NearestWord, IsNoneForAWordFarFromAll) {
  EXPECT_EQ(nearest_word("simulate", {"check", "run"}), "");
  EXPECT_EQ(nearest_word("", {"run"}), "");
  EXPECT_EQ(nearest_word("gpu", {"timestep_s", "ranks"}), "");
}

}  // namespace
}  // namespace dipper
