#include "coupler/launch/mpi_scratch.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <string>

namespace dipper::launch {
namespace {

namespace fs = std::filesystem;

/// A child that has its scratch folder, a file in it, and ends as asked; the folder.
fs::path folder_of_one_that(bool is_killed) {
  int pipe_ends[2];
  EXPECT_EQ(pipe(pipe_ends), 0);
  const pid_t child = fork();
  if (child == 0) {
    const std::string folder = mpi_scratch().string();
    std::ofstream(fs::path(folder) / "session") << "left";
    if (write(pipe_ends[1], folder.data(), folder.size()) < 0) _exit(1);
    if (is_killed) raise(SIGKILL);
    exit(0);
  }
  close(pipe_ends[1]);
  char text[4096];
  const auto n = read(pipe_ends[0], text, sizeof text);
  close(pipe_ends[0]);
  waitpid(child, nullptr, 0);
  return std::string(text, static_cast<std::size_t>(n));
}

TEST(MpiScratch, IsGoneWhenItsProcessEnds) { EXPECT_FALSE(fs::exists(folder_of_one_that(false))); }

TEST(MpiScratch, OfAKilledProcessIsGoneWhenTheNextOneStarts) {
  const fs::path left = folder_of_one_that(true);
  EXPECT_TRUE(fs::exists(left / "session"));
  const fs::path next = folder_of_one_that(false);
  EXPECT_NE(next, left);
  EXPECT_FALSE(fs::exists(left));
}

TEST(MpiScratch, OfALivingProcessStays) {
  const fs::path ours = mpi_scratch();
  EXPECT_EQ(mpi_scratch(), ours);
  folder_of_one_that(false);
  EXPECT_TRUE(fs::is_directory(ours));
}

}  // namespace
}  // namespace dipper::launch
