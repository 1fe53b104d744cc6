#include "coupler/launch/process.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <thread>

namespace dipper::launch {
namespace {

namespace fs = std::filesystem;

/// Where a program's words go, for as long as a test takes.
struct Log {
  Log() { std::ofstream{file}; }
  ~Log() { fs::remove(file); }
  fs::path file = fs::temp_directory_path() / ("process_test" + std::to_string(getpid()));
};

TEST(Process, CpuTimeIsKnownWhileItRuns) {
  const Log log;
  Process busy({"sh", "-c", "sh -c 'while :; do :; done' & wait"}, log.file);
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (busy.cpu_s() < 0.1 && std::chrono::steady_clock::now() < deadline) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  EXPECT_GE(busy.cpu_s(), 0.1);
  EXPECT_FALSE(busy.ended());
}

TEST(Process, WorksInTheFolderItIsGiven) {
  const Log log;
  const fs::path folder = fs::canonical(fs::temp_directory_path());
  Process there({"pwd"}, log.file, folder);
  ASSERT_TRUE(there.wait(std::chrono::seconds(20)));
  std::string said;
  std::getline(std::ifstream(log.file), said);
  EXPECT_EQ(said, folder.string());
  Process nowhere({"pwd"}, log.file, folder / "is not there");
  ASSERT_TRUE(nowhere.wait(std::chrono::seconds(20)));
  EXPECT_FALSE(nowhere.succeeded());
}

TEST(Process, WhatAProgramHasStartedEndsWithIt) {
  const Log log;
  pid_t grandchild = 0;
  {
    const Process program({"sh", "-c", "sleep 300 & echo $!; wait"}, log.file);
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (!(std::ifstream(log.file) >> grandchild) &&
           std::chrono::steady_clock::now() < deadline) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  }
  ASSERT_GT(grandchild, 0);
  const auto lives = [&] {  // a zombie that nobody waits for is gone, too
    std::string ignored;
    char state = 'Z';
    std::ifstream(fmt::format("/proc/{}/stat", grandchild)) >> ignored >> ignored >> state;
    return state != 'Z';
  };
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (lives() && std::chrono::steady_clock::now() < deadline) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  EXPECT_FALSE(lives());
}

}  // namespace
}  // namespace dipper::launch
