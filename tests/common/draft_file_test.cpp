#include "common/draft_file.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "common/temporary_folder.hpp"

namespace dipper {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }

TEST(DraftFile, TakesItsNameWhenItIsKept) {
  const TemporaryFolder folder("dipper-draft");
  const fs::path film = folder.path() / "dig.mp4";
  write(film, "the one before");
  {
    const DraftFile draft(film);
    EXPECT_EQ(draft.path().extension(), ".mp4");  // what writes it may go by that
    EXPECT_EQ(draft.path().parent_path(), folder.path());
    write(draft.path(), "new");
    draft.keep();
  }
  std::string text;
  std::getline(std::ifstream(film) >> std::ws, text);
  EXPECT_EQ(text, "new");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

TEST(DraftFile, LeavesNothingWhenItIsNot) {
  const TemporaryFolder folder("dipper-draft");
  const fs::path film = folder.path() / "dig.mp4";
  write(film, "the one before");
  {
    const DraftFile draft(film);
    write(draft.path(), "half");
  }
  EXPECT_EQ(fs::file_size(film), 14U);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

TEST(DraftFile, OfALinkIsOneOfWhatItLeadsTo) {
  const TemporaryFolder folder("dipper-draft"), other("dipper-draft");
  const fs::path film = folder.path() / "dig.mp4", link = other.path() / "link.mp4";
  write(film, "the one before");
  fs::create_symlink(film, link);
  {
    const DraftFile draft(link);
    write(draft.path(), "half");
  }
  EXPECT_EQ(fs::file_size(film), 14U);
  {
    const DraftFile draft(link);
    write(draft.path(), "new");
    draft.keep();
  }
  EXPECT_EQ(fs::file_size(film), 3U);
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

TEST(TemporaryFolder, IsGoneWithWhatIsInIt) {
  fs::path was;
  {
    const TemporaryFolder folder("dipper-test"), other("dipper-test");
    was = folder.path();
    EXPECT_NE(folder.path(), other.path());
    EXPECT_EQ(was.filename().string().rfind("dipper-test-", 0), 0U);
    fs::create_directories(was / "a/b");
    write(was / "a/b/file", "text");
  }
  EXPECT_FALSE(fs::exists(was));
}

}  // namespace
}  // namespace dipper
