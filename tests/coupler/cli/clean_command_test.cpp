#include "coupler/cli/clean_command.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "common/cache_folder.hpp"
#include "common/file_lock.hpp"
#include "common/input_error.hpp"
#include "tests/common/memory_reporter.hpp"

namespace dipper::cli {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class CleanCommand : public testing::Test {
 protected:
  CleanCommand() {
    std::string name = (fs::temp_directory_path() / "dipper-clean-XXXXXX").string();
    root = mkdtemp(name.data());
    run = root / "run";
    fs::create_directories(root / "cache");
    set_cache_folder(root / "cache");
  }
  ~CleanCommand() override { fs::remove_all(root); }

  static void put(const fs::path& file, std::size_t size) {
    fs::create_directories(file.parent_path());
    std::ofstream(file) << std::string(size, 'x');
  }

  void put_run() {
    put(run / "record.h5", 1000);
    put(run / "summary.json", 10);
    put(run / "dumps" / "rocks_0.dump", 2'000'000);
    put(run / "checkpoints" / "000000010" / "rock.restart", 1'500'000);
    put(run / "events.lcmlog", 400'000);
    put(run / "events-10.lcmlog", 100'000);
  }

  std::string output_of(std::vector<std::string> words) {
    CLI::App app;
    test::MemoryReporter reporter;
    const Command command = add_clean_command(app, reporter);
    words.insert(words.begin(), "clean");
    std::reverse(words.begin(), words.end());
    app.parse(words);
    EXPECT_EQ(command.run(), 0);
    return reporter.lines;
  }

  fs::path root, run;
};

TEST_F(CleanCommand, ListsFirstAndRemovesWhenAsked) {
  put_run();
  const std::string said = output_of({run.string()});
  EXPECT_THAT(said, HasSubstr("2.0 MB  " + (run / "dumps").string()));
  EXPECT_THAT(said, HasSubstr("1.5 MB  " + (run / "checkpoints").string()));
  EXPECT_THAT(said, HasSubstr("0.5 MB  " + (run / "messages").string()));
  EXPECT_THAT(said, HasSubstr("4.0 MB  can be freed"));
  EXPECT_TRUE(fs::exists(run / "dumps" / "rocks_0.dump"));

  EXPECT_THAT(output_of({run.string(), "--yes"}), HasSubstr("4.0 MB  freed"));
  for (const char* gone : {"dumps", "checkpoints", "events.lcmlog", "events-10.lcmlog"})
    EXPECT_FALSE(fs::exists(run / gone)) << gone;
  for (const char* kept : {"record.h5", "summary.json"}) EXPECT_TRUE(fs::exists(run / kept));
}

TEST_F(CleanCommand, CountsARunOnceAndRemovesNothingBesideWhatIsNoRun) {
  put_run();
  const std::string again = (run / ".." / "run").string();
  EXPECT_THAT(output_of({run.string(), again}), HasSubstr("4.0 MB  can be freed"));
  EXPECT_THAT(
      [&] {
        output_of({run.string(), root.string(), "--yes"});
      },
      testing::ThrowsMessage<InputError>(HasSubstr("is not a run")));
  EXPECT_TRUE(fs::exists(run / "dumps" / "rocks_0.dump"));
}

TEST_F(CleanCommand, LeavesWhatIsNoRunAndWhatIsBeingWritten) {
  EXPECT_THAT([&] { output_of({root.string()}); },
              testing::ThrowsMessage<InputError>(HasSubstr("is not a run")));
  put_run();
  FileLock writer(run / "run.lock");
  ASSERT_TRUE(writer.try_lock());
  EXPECT_THAT(
      [&] {
        output_of({run.string(), "--yes"});
      },
      testing::ThrowsMessage<InputError>(HasSubstr("a run is writing it")));
  EXPECT_TRUE(fs::exists(run / "dumps" / "rocks_0.dump"));
}

TEST_F(CleanCommand, EmptiesTheCacheButForWhatIsBeingMade) {
  put(root / "cache" / "piles" / "a" / "pile.restart", 3'000'000);
  put(root / "cache" / "piles" / "b" / "pile.restart", 1'000'000);
  put(root / "cache" / "piles" / "b.42.part" / "pile.restart", 1'000'000);
  FileLock maker(root / "cache" / "piles" / "b.lock");
  ASSERT_TRUE(maker.try_lock());
  EXPECT_THAT(output_of({"cache", "--yes"}), HasSubstr("3.0 MB  freed"));
  EXPECT_FALSE(fs::exists(root / "cache" / "piles" / "a"));
  EXPECT_TRUE(fs::exists(root / "cache" / "piles" / "b"));
  EXPECT_TRUE(fs::exists(root / "cache" / "piles" / "b.42.part"));
}

}  // namespace
}  // namespace dipper::cli
