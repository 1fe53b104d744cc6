#include "coupler/cli/console.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>

namespace dipper::cli {
namespace {

TEST(Console, OffATerminalShowsTheFirstAndTheLastProgressOfAShortWork) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  {
    Console console;
    console.line("begins");
    for (const char* share : {"10 %", "20 %", "100 %"}) console.progress(share);
    console.line("ends");
    console.error("fails");
  }
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "begins\n10 %\n100 %\nends\n");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "dipper: fails\n");
}

TEST(Console, AReaderThatHasGoneIsNoFault) {
  std::fflush(stdout);
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  const int out = dup(STDOUT_FILENO);
  const auto before = std::signal(SIGPIPE, SIG_IGN);
  dup2(ends[1], STDOUT_FILENO);
  close(ends[0]);
  close(ends[1]);
  Console console;
  console.line("nobody reads this");
  console.progress("nor this");
  dup2(out, STDOUT_FILENO);
  close(out);
  std::clearerr(stdout);
  std::signal(SIGPIPE, before);
}

}  // namespace
}  // namespace dipper::cli
