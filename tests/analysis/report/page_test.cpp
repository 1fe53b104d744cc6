#include "analysis/report/page.hpp"

#include <gmock/gmock.h>

#include <fstream>

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

TEST(Page, LeavesNothingHalfWritten) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "page_test";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directory(folder);
  write_page("text", folder / "page.html");
  std::ifstream in(folder / "page.html");
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(in), {}), "text");
  std::filesystem::create_directory(folder / "taken.html");
  EXPECT_THROW(write_page("text", folder / "taken.html"), std::runtime_error);
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    EXPECT_THAT(entry.path().string(), Not(HasSubstr(".part")));
    ++files;
  }
  EXPECT_EQ(files, 2u);
}

}  // namespace
}  // namespace dipper::analysis::report
