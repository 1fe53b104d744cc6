// Whole processes want one entry of a cache at once, and some are killed.
#include "common/cache_entry.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace dipper {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;

void nothing() {}

class CacheEntry : public testing::Test {
 protected:
  CacheEntry() { fs::remove_all(folder_); }
  ~CacheEntry() override { fs::remove_all(folder_); }

  /// Runs `work` in a process of its own.
  template <typename Work>
  static pid_t start(const Work& work) {
    const pid_t child = fork();
    if (child != 0) return child;
    try {
      work();
    } catch (...) {
      _exit(99);
    }
    _exit(0);
  }
  /// Writes a file in two steps, `pause` apart, and adds a line to a log first.
  auto writer(milliseconds pause) const {
    return [this, pause](const fs::path& part) {
      std::ofstream(log_, std::ios::app) << getpid() << '\n';
      std::ofstream out(part / "data");
      out << "half " << std::flush;
      std::this_thread::sleep_for(pause);
      out << "whole";
    };
  }
  static int status(pid_t child) {
    int s = 0;
    waitpid(child, &s, 0);
    return s;
  }
  void until_someone_writes() const {
    while (lines() == 0) std::this_thread::sleep_for(milliseconds(5));
  }
  int lines() const {
    std::ifstream in(log_);
    int n = 0;
    for (std::string line; std::getline(in, line);) ++n;
    return n;
  }
  std::string data() const {
    std::ifstream in(entry_ / "data");
    std::string text;
    std::getline(in, text);
    return text;
  }
  /// All that is left in the cache is the entry: no parts, no locks.
  bool clean() const {
    std::size_t n = 0;
    for (const auto& f : fs::directory_iterator(entry_.parent_path()))
      n += f.path() == entry_ ? 0 : 1;
    return n == 0;
  }

  const fs::path folder_ =
      fs::path(testing::TempDir()) / ("cache_entry" + std::to_string(getpid()));
  const fs::path entry_ = folder_ / "cache" / "abc";
  const fs::path log_ = folder_ / "log";
};

TEST_F(CacheEntry, OfFourAtOnceOneWritesAndAllFindItWhole) {
  fs::create_directories(folder_);
  std::vector<pid_t> children;
  for (int k = 0; k < 4; ++k)
    children.push_back(start([&] {
      make_once(entry_, writer(milliseconds(300)), nothing);
      if (data() != "half whole") throw std::runtime_error(data());
    }));
  for (const pid_t child : children) EXPECT_EQ(status(child), 0);
  EXPECT_EQ(lines(), 1);
  EXPECT_TRUE(clean());
}

TEST_F(CacheEntry, OneThatWaitsTakesOverFromAKilledWriter) {
  fs::create_directories(folder_);
  const pid_t first = start([&] { make_once(entry_, writer(milliseconds(60'000)), nothing); });
  until_someone_writes();
  const pid_t second = start([&] { make_once(entry_, writer(milliseconds(0)), nothing); });
  std::this_thread::sleep_for(milliseconds(200));
  EXPECT_EQ(lines(), 1);  // the second waits
  EXPECT_FALSE(fs::exists(entry_));
  kill(first, SIGKILL);
  EXPECT_TRUE(WIFSIGNALED(status(first)));
  EXPECT_EQ(status(second), 0);
  EXPECT_EQ(lines(), 2);
  EXPECT_EQ(data(), "half whole");
  EXPECT_TRUE(clean());
}

TEST_F(CacheEntry, PartsOfTheDeadGoAndPartsOfTheLivingStay) {
  const fs::path dead = folder_ / "cache" / "old.123.part";
  fs::create_directories(dead / "below");
  const fs::path other = folder_ / "cache" / "other";
  const pid_t living = start([&] { make_once(other, writer(milliseconds(60'000)), nothing); });
  until_someone_writes();
  EXPECT_TRUE(make_once(entry_, writer(milliseconds(0)), nothing));
  EXPECT_FALSE(fs::exists(dead));
  EXPECT_TRUE(fs::exists(other.string() + '.' + std::to_string(living) + ".part"));
  kill(living, SIGKILL);
  status(living);
}

TEST_F(CacheEntry, AFailureLeavesNothingAndIsPassedOn) {
  const auto fail = [](const fs::path&) { throw std::runtime_error("no room"); };
  EXPECT_THROW(make_once(entry_, fail, nothing), std::runtime_error);
  EXPECT_FALSE(fs::exists(entry_));
  EXPECT_TRUE(clean());
  EXPECT_TRUE(make_once(entry_, writer(milliseconds(0)), nothing));
  EXPECT_FALSE(make_once(entry_, fail, nothing));
}

TEST_F(CacheEntry, AnEntryThatIsNotWhatWasWrittenIsSetAsideAndMadeAgain) {
  fs::create_directories(folder_);
  const auto flip = [&] {
    std::fstream file(entry_ / "data", std::ios::in | std::ios::out);
    file.put('H');
  };
  const auto cut = [&] { fs::resize_file(entry_ / "data", 4); };
  const auto lose = [&] { fs::remove(entry_ / "data"); };
  const auto unseal = [&] { fs::remove(entry_ / "manifest.sha256"); };
  make_once(entry_, writer(milliseconds(0)), nothing);
  for (const std::function<void()>& damage :
       {std::function<void()>(flip), {cut}, {lose}, {unseal}}) {
    EXPECT_TRUE(is_sound(entry_));
    damage();
    EXPECT_FALSE(is_sound(entry_));
    testing::internal::CaptureStderr();
    EXPECT_TRUE(make_once(entry_, writer(milliseconds(0)), nothing));
    const std::string said = testing::internal::GetCapturedStderr();
    EXPECT_NE(said.find(entry_.string() + "/"), std::string::npos) << said;
    EXPECT_NE(said.find(entry_.string() + ".damaged"), std::string::npos) << said;
    EXPECT_EQ(data(), "half whole");
    EXPECT_FALSE(make_once(entry_, writer(milliseconds(0)), nothing));
  }
}

TEST_F(CacheEntry, WhoWaitsMayGiveUp) {
  fs::create_directories(folder_);
  const pid_t first = start([&] { make_once(entry_, writer(milliseconds(60'000)), nothing); });
  until_someone_writes();
  EXPECT_THROW(make_once(entry_, writer(milliseconds(0)), [] { throw std::logic_error("enough"); }),
               std::logic_error);
  EXPECT_EQ(lines(), 1);
  kill(first, SIGKILL);
  status(first);
}

}  // namespace
}  // namespace dipper
