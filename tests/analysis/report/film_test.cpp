// A run's page as a film: what is missing is reported before anything is drawn, and what is there
// is drawn.
#include "analysis/report/film.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "analysis/report/report_page.hpp"
#include "tests/analysis/dump_files.hpp"
#include "tests/analysis/report/synthetic_dig.hpp"
#include "tests/common/memory_reporter.hpp"

namespace dipper::analysis::report {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;
namespace fs = std::filesystem;

TEST(Film, NamesWhatToInstallAndWhatIsNoFilm) {
  const Scratch s;
  const fs::path video = s.folder() / "dig.mp4", poster = s.folder() / "dig.png";
  const std::string path = std::getenv("PATH");
  setenv("PATH", s.folder().c_str(), 1);
  EXPECT_EQ(film_obstacle({}), "");
  EXPECT_THAT(film_obstacle({video, {}}), HasSubstr("apt-get install chromium"));
  fs::permissions(s.write("chromium", "#!/bin/sh\n"), fs::perms::owner_all);
  EXPECT_THAT(film_obstacle({video, {}}), HasSubstr("apt-get install ffmpeg"));
  EXPECT_EQ(film_obstacle({{}, poster}), "");
  fs::permissions(s.write("ffmpeg", "#!/bin/sh\n"), fs::perms::owner_all);
  EXPECT_EQ(film_obstacle({video, poster}), "");
  EXPECT_THAT(film_obstacle({s.folder() / "dig.avi", {}}), EndsWith("dig.avi: a video is an .mp4"));
  EXPECT_THAT(film_obstacle({{}, s.folder() / "dig"}), HasSubstr("a poster is a .png or a .jpg"));
  EXPECT_THAT(film_obstacle({s.folder() / "no/dig.mp4", {}}), HasSubstr("cannot be written into"));
  setenv("PATH", path.c_str(), 1);
}

TEST(Film, ABrowserThatEndsIsReported) {
  const Scratch s;
  const std::string path = std::getenv("PATH");
  fs::permissions(s.write("chromium", "#!/bin/sh\n"), fs::perms::owner_all);
  setenv("PATH", s.folder().c_str(), 1);
  test::MemoryReporter reporter;
  EXPECT_THAT(
      [&] {
        write_film(s.folder() / "page.html", {{}, s.folder() / "p.png"}, reporter);
      },
      testing::ThrowsMessage<std::runtime_error>(HasSubstr("the browser")));
  EXPECT_FALSE(fs::exists(s.folder() / "p.png"));
  setenv("PATH", path.c_str(), 1);
}

TEST(Film, HasAPosterAndAVideo) {
  const Scratch s;
  const test::SyntheticDig dig(60, 3, 0.2);
  ReportInput input;
  input.replay = &dig;
  const fs::path page = s.folder() / "page.html", video = s.folder() / "it's a dig.mp4",
                 poster = s.folder() / "dig.png";
  write_report_page("A synthetic dig", input, page);
  ASSERT_EQ(film_obstacle({video, poster}), "");
  test::MemoryReporter reporter;
  write_film(page, {video, poster}, reporter);
  const auto bytes_of = [](const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  const std::string png = bytes_of(poster), mp4 = bytes_of(video);
  ASSERT_THAT(png, StartsWith("\x89PNG"));
  EXPECT_EQ(png.substr(16, 8), std::string("\0\0\5\0\0\0\2\xd0", 8));  // 1280 x 720
  EXPECT_GT(png.size(), 5000u) << "a picture of nothing";
  EXPECT_EQ(mp4.substr(4, 4), "ftyp");
  EXPECT_THAT(mp4, HasSubstr("moov"));
  EXPECT_EQ(std::distance(fs::directory_iterator(s.folder()), {}), 3) << "something is left";
}

}  // namespace
}  // namespace dipper::analysis::report
