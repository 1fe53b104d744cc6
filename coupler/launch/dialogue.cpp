#include "coupler/launch/dialogue.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "coupler/launch/failure_message.hpp"

namespace dipper::launch {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kLongestLine = std::size_t{64} << 20;
constexpr int kLook_ms = 50;

[[noreturn]] void fail(const std::string& what) {
  throw std::runtime_error(what + ": " + strerror(errno));
}

/// A pipe whose ends close with this.
struct Pipe {
  Pipe() {
    if (pipe2(ends.data(), O_CLOEXEC) != 0) fail("cannot make a pipe");
  }
  ~Pipe() {
    for (const int end : ends)
      if (end >= 0) close(end);
  }
  int take(std::size_t end) { return std::exchange(ends.at(end), -1); }
  std::array<int, 2> ends{-1, -1};  ///< to read from, to write to
};

}  // namespace

Dialogue::Dialogue(const std::vector<std::string>& command, const std::filesystem::path& log,
                   const std::filesystem::path& folder, std::chrono::milliseconds patience,
                   std::function<void()> watch)
    : log_(log), patience_(patience), watch_(std::move(watch)) {
  Pipe to, from;
  process_ = std::make_unique<Process>(command, log, folder, Streams{to.ends[0], from.ends[1]});
  to_ = to.take(1);
  from_ = from.take(0);
  for (const int file : {to_, from_}) fcntl(file, F_SETFL, O_NONBLOCK);
}

Dialogue::~Dialogue() { close_files(); }

void Dialogue::close_files() {
  for (int* file : {&to_, &from_})
    if (*file >= 0) close(std::exchange(*file, -1));
}

void Dialogue::report_end() {
  process_->wait(std::chrono::milliseconds(1000));
  throw std::runtime_error(process_->ended() ? failure_message(*process_, log_)
                                             : "closed its stdin or stdout but keeps running");
}

void Dialogue::wait_for(int file, short event, const char* doing, Clock::time_point began,
                        double starved_s) {
  pollfd p{file, event, 0};
  while (poll(&p, 1, kLook_ms) <= 0) {
    watch_();
    const std::chrono::duration<double> waited = Clock::now() - began;
    const double without_core_s = process_->starved_s() - starved_s;
    if (waited.count() - without_core_s > std::chrono::duration<double>(patience_).count())
      throw std::runtime_error(
          fmt::format("{} for {:g} s", doing, std::chrono::duration<double>(patience_).count()));
  }
}

void Dialogue::say(const std::string& line) {
  const std::string bytes = line + '\n';
  const auto began = Clock::now();
  const double starved_s = process_->starved_s();
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t n = write(to_, bytes.data() + done, bytes.size() - done);
    if (n > 0) done += static_cast<std::size_t>(n);
    if (n >= 0 || errno == EINTR) continue;
    if (errno != EAGAIN) report_end();
    wait_for(to_, POLLOUT, "does not read its stdin", began, starved_s);
  }
}

std::string Dialogue::hear() {
  const auto began = Clock::now();
  const double starved_s = process_->starved_s();
  std::array<char, 65536> bytes{};
  std::size_t looked = 0;
  while (true) {
    const std::size_t end = heard_.find('\n', looked);
    if (end != std::string::npos) {
      std::string line = heard_.substr(0, end);
      heard_.erase(0, end + 1);
      return line;
    }
    looked = heard_.size();
    if (looked > kLongestLine)
      throw std::runtime_error(fmt::format("a line of more than {} MiB", kLongestLine >> 20));
    const ssize_t n = read(from_, bytes.data(), bytes.size());
    if (n > 0) heard_.append(bytes.data(), static_cast<std::size_t>(n));
    if (n > 0 || (n < 0 && errno == EINTR)) continue;
    if (n == 0 || errno != EAGAIN) report_end();
    wait_for(from_, POLLIN, "no answer", began, starved_s);
  }
}

bool Dialogue::dismiss(std::chrono::milliseconds patience) {
  close_files();
  const bool by_itself = process_->wait(patience);
  process_->end();
  return by_itself && process_->succeeded();
}

}  // namespace dipper::launch
