#include "common/text_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <functional>

#include "common/temporary_folder.hpp"

namespace dipper {
namespace {

namespace fs = std::filesystem;

class TextFile : public testing::Test {
 protected:
  std::ptrdiff_t files() const {
    return std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator{});
  }

  const TemporaryFolder folder_{"dipper-text"};
  const fs::path file_ = folder_.path() / "settings.txt";
};

TEST_F(TextFile, HoldsTheBytes) {
  write_text(file_, "before, and longer");
  write_text(file_, std::string("a\0\r\n", 4));
  EXPECT_EQ(read_bytes(file_), std::string("a\0\r\n", 4));
  EXPECT_EQ(files(), 1);
}

TEST_F(TextFile, IsReadToItsEndOrNotAtAll) {
  const std::string longer(200'000, 'x');
  write_text(file_, longer);
  EXPECT_EQ(read_bytes(file_), longer);
  write_text(file_, "");
  EXPECT_EQ(read_bytes(file_), "");
  EXPECT_EQ(read_bytes(folder_.path() / "missing"), std::nullopt);
  EXPECT_EQ(read_bytes(folder_.path()), std::nullopt) << "a folder";
  // Opens, and then fails at its first byte (EIO), as /proc/PID/stat does when PID has just ended.
  EXPECT_EQ(read_bytes("/proc/self/mem"), std::nullopt);
}

/// As on a full disk: a write fails, and the process goes on.
void with_room_for(rlim_t bytes, const std::function<void()>& write) {
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit less{bytes, before.rlim_max};
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &less);
  write();
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
}

TEST_F(TextFile, HoldsWhatItHeldWhenTheDiskIsFull) {
  write_text(file_, "seed=7\n");
  with_room_for(100, [&] {
    EXPECT_THAT([&] { write_text(file_, std::string(1000, 'x')); },
                testing::ThrowsMessage<std::runtime_error>(
                    testing::StartsWith(file_.string() + ": cannot be written")));
  });
  EXPECT_EQ(read_bytes(file_), "seed=7\n");
  EXPECT_EQ(files(), 1);
}

TEST_F(TextFile, HoldsWhatItHeldWhenItsWriterIsKilled) {
  write_text(file_, "seed=7\n");
  const auto killed = [&] {
    const rlimit bytes{100, 100};
    setrlimit(RLIMIT_FSIZE, &bytes);
    write_text(file_, std::string(1000, 'x'));
  };
  EXPECT_EXIT(killed(), testing::KilledBySignal(SIGXFSZ), "");
  EXPECT_EQ(read_bytes(file_), "seed=7\n");
}

TEST_F(TextFile, NeverTakesTheNameOfAFolder) {
  fs::create_directory(file_);
  EXPECT_THROW(write_text(file_, "text"), std::runtime_error);
  EXPECT_TRUE(fs::is_directory(file_));
  EXPECT_EQ(files(), 1);
}

TEST_F(TextFile, GoesThroughALinkAndIntoADevice) {
  const fs::path link = folder_.path() / "link";
  write_text(file_, "before");
  fs::create_symlink(file_, link);
  write_text(link, "new");
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_EQ(read_bytes(file_), "new");
  EXPECT_EQ(files(), 2);
  EXPECT_THROW(write_text("/dev/full", "text"), std::runtime_error);
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

}  // namespace
}  // namespace dipper
