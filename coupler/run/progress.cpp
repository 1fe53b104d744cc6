#include "coupler/run/progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace dipper::run {

using Clock = std::chrono::steady_clock;

Progress::Progress(Reporter& reporter, double start_s, double end_s, std::size_t payload)
    : reporter_(reporter),
      began_(Clock::now()),
      start_s_(start_s),
      end_s_(end_s),
      payload_(payload) {}

void Progress::window(const core::Window& w) {
  if (w.step_index == 0) return;
  constexpr int kWidth = 12;  // the whole is less than 80 columns
  const double t_s = static_cast<double>(w.rock.t_ns) * 1e-9;
  const double share = std::clamp((t_s - start_s_) / std::max(end_s_ - start_s_, 1e-9), 0.0, 1.0);
  const int filled = static_cast<int>(share * kWidth);
  const double wall_s = std::chrono::duration<double>(Clock::now() - began_).count();
  const double factor = (t_s - start_s_) / std::max(wall_s, 1e-9);
  const double left_s = factor > 0 ? std::max(0.0, end_s_ - t_s) / factor : 0;
  reporter_.progress(fmt::format(
      "[{}{}] {:6.2f} / {:.2f} s  payload {:5.1f} t  {}:{:02d} left  {:.3f} x real time",
      std::string(static_cast<std::size_t>(filled), '#'),
      std::string(static_cast<std::size_t>(kWidth - filled), '.'), t_s, end_s_,
      w.rock.channels[payload_] * 1e-3, static_cast<int>(left_s) / 60,
      static_cast<int>(left_s) % 60, factor));
}

}  // namespace dipper::run
