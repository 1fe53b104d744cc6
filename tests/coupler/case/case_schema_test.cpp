#include <gtest/gtest.h>

#include <set>

#include "coupler/case/schema.hpp"
#include "tests/coupler/case/checkout.hpp"

namespace dipper::cases {
namespace {

TEST(Schema, KeysAreUniqueAndCarryTheirUnit) {
  std::set<std::string> keys;
  for (const KeySpec& spec : schema()) {
    EXPECT_TRUE(keys.insert(spec.key).second) << spec.key;
    EXPECT_FALSE(spec.doc.empty()) << spec.key;
    EXPECT_EQ(spec.stem() + unit_suffix(spec.unit), spec.leaf());
  }
}

TEST(Schema, DocsListEveryKeyAsItIs) {
  const std::string docs = test::read_text(std::filesystem::path(DIPPER_SOURCE) / "docs/case.md");
  EXPECT_NE(docs.find(schema_markdown()), std::string::npos)
      << "docs/case.md is behind; its table of keys is:\n"
      << schema_markdown();
}

TEST(Schema, Ranges) {
  EXPECT_EQ((Range{0, 1e300, true, false}.text()), "> 0");
  EXPECT_EQ((Range{0, 1e300, false, false}.text()), ">= 0");
  EXPECT_EQ((Range{0, 0.5, true, true}.text()), "> 0 and < 0.5");
  EXPECT_EQ((Range{-360, 360, false, false}.text()), "-360 ... 360");
  EXPECT_EQ(Range{}.text(), "");
  EXPECT_FALSE((Range{0, 1, true, true}.holds(0)));
  EXPECT_FALSE((Range{0, 1, true, true}.holds(1)));
  EXPECT_TRUE((Range{0, 1, false, false}.holds(0)));
}

}  // namespace
}  // namespace dipper::cases
