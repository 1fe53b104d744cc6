#include "coupler/cli/console.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdio>

namespace dipper::cli {
namespace {

// Not fmt::print, which throws when the reading end is closed.
void put(std::FILE* to, const std::string& text) {
  std::fputs(text.c_str(), to);
  std::fflush(to);
}

/// Cuts a progress line (one byte per column) to the terminal's width, if that is known.
std::string cut_to_terminal(const std::string& text) {
  winsize size{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col < 2) return text;
  return text.substr(0, size.ws_col - 1U);  // text in the last column would begin a new line
}

}  // namespace

Console::Console() : terminal_(isatty(STDOUT_FILENO) != 0) {}

void Console::line(const std::string& text) {
  end_progress();
  put(stdout, text + "\n");
}

void Console::error(const std::string& text) {
  end_progress();
  put(stderr, "dipper: " + text + "\n");
}

void Console::progress(const std::string& text) {
  const auto now = std::chrono::steady_clock::now();
  const auto pause = terminal_ ? std::chrono::milliseconds(200) : std::chrono::seconds(10);
  if (now - shown_ < pause) {
    pending_ = text;
    return;
  }
  show(text);
  shown_ = now;
}

void Console::show(const std::string& text) {
  put(stdout, terminal_ ? "\r" + cut_to_terminal(text) + "\033[K" : text + "\n");
  begun_ = terminal_;
  pending_.clear();
}

void Console::end_progress() {
  if (!pending_.empty()) show(pending_);
  if (begun_) put(stdout, "\n");
  begun_ = false;
}

}  // namespace dipper::cli
