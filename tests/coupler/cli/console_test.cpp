#include "coupler/cli/console.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <pty.h>
#include <unistd.h>

#include <csignal>
#include <string>

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

TEST(Console, KeepsProgressWithinTheTerminalsWidth) {
  std::fflush(stdout);
  winsize narrow{};
  narrow.ws_col = 40;
  narrow.ws_row = 10;
  int near = -1, far = -1;
  ASSERT_EQ(openpty(&near, &far, nullptr, nullptr, &narrow), 0);
  const int out = dup(STDOUT_FILENO);
  dup2(far, STDOUT_FILENO);
  {
    Console console;
    console.progress(std::string(92, '#'));
  }
  dup2(out, STDOUT_FILENO);
  close(out);
  std::string shown;  // a terminal hands on what was written in as many pieces as it likes
  pollfd ready{near, POLLIN, 0};
  while ((shown.empty() || shown.back() != '\n') && poll(&ready, 1, 5000) == 1) {
    char piece[256];
    const auto n = read(near, piece, sizeof piece);
    if (n <= 0) break;
    shown.append(piece, static_cast<std::size_t>(n));
  }
  close(near);
  close(far);
  EXPECT_EQ(shown, "\r" + std::string(39, '#') + "\033[K\r\n");
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
