#include "analysis/report/page.hpp"

#include <gmock/gmock.h>

#include "analysis/report/web_bundle.hpp"

namespace dipper::analysis::report {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(Page, IsWholeAndSaysItsTitleAsText) {
  const std::string text = page({{"kind", "gap"}, {"title", "<b>R&D</b>"}});
  EXPECT_THAT(text, testing::StartsWith("<!doctype html>"));
  EXPECT_THAT(text, HasSubstr("<title>&lt;b&gt;R&amp;D&lt;/b&gt; – Dipper</title>"));
  EXPECT_THAT(text, testing::EndsWith("</html>\n"));
  EXPECT_THAT(text, Not(HasSubstr("src=\"http")));
}

TEST(Page, PicksTheScriptOfItsKind) {
  for (const PageScript& script : page_scripts()) {
    const std::string text = page({{"kind", std::string(script.kind)}, {"title", "t"}});
    EXPECT_THAT(text, HasSubstr(std::string(script.text))) << script.kind;
  }
  // Only a run's page has the 3-D library inside.
  EXPECT_LT(page({{"kind", "gap"}, {"title", "t"}}).size(), 300'000u);
}

TEST(Page, RefusesWhatIsNoPage) {
  EXPECT_THROW(page({{"kind", "weather"}, {"title", "t"}}), std::invalid_argument);
  EXPECT_THROW(page({{"kind", "gap"}}), std::invalid_argument);
  EXPECT_THROW(page({{"kind", 3}, {"title", "t"}}), std::invalid_argument);
  EXPECT_THROW(page(nlohmann::json::array()), std::invalid_argument);
  try {
    page({{"kind", "weather"}, {"title", "t"}});
  } catch (const std::invalid_argument& e) {
    EXPECT_THAT(e.what(), HasSubstr("gap, run"));
  }
}

}  // namespace
}  // namespace dipper::analysis::report
