#include "coupler/run/progress.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace dipper::run {

using Clock = std::chrono::steady_clock;

Progress::Progress(double start_s, double end_s)
    : began_(Clock::now()), start_s_(start_s), end_s_(end_s), terminal_(isatty(1) != 0) {}

std::string Progress::line(double t_s, double payload_kg) const {
  constexpr int kWidth = 24;
  const double share = std::clamp((t_s - start_s_) / std::max(end_s_ - start_s_, 1e-9), 0.0, 1.0);
  const int filled = static_cast<int>(share * kWidth);
  const double wall_s = std::chrono::duration<double>(Clock::now() - began_).count();
  const double factor = (t_s - start_s_) / std::max(wall_s, 1e-9);
  const double left_s = factor > 0 ? (end_s_ - t_s) / factor : 0;
  return fmt::format(
      "[{}{}] {:6.2f} / {:.2f} s  {:.3f} x real time  payload {:5.1f} t  {}:{:02d} left",
      std::string(filled, '#'), std::string(kWidth - filled, '.'), t_s, end_s_, factor,
      payload_kg * 1e-3, static_cast<int>(left_s) / 60, static_cast<int>(left_s) % 60);
}

void Progress::show(double t_s, double payload_kg) {
  const auto now = Clock::now();
  const auto pause = terminal_ ? std::chrono::milliseconds(200) : std::chrono::milliseconds(10000);
  if (shown_ && now - last_ < pause && t_s < end_s_) return;
  shown_ = true;
  last_ = now;
  fmt::print(terminal_ ? "\r{}\033[K" : "{}\n", line(t_s, payload_kg));
  std::fflush(stdout);
}

void Progress::done() {
  if (terminal_ && shown_) fmt::print("\n");
}

}  // namespace dipper::run
