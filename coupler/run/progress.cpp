#include "coupler/run/progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace dipper::run {
namespace {

using Clock = std::chrono::steady_clock;

std::string duration(double s) {
  if (s < 99.5) return fmt::format("{:.0f} s", s);
  if (s < 99.5 * 60) return fmt::format("{:.0f} min", s / 60);
  return fmt::format("{:.1f} h", s / 3600);
}

}  // namespace

Progress::Progress(Reporter& reporter, const cases::Case& c, const RunEnd& end,
                   const core::ServerInfo& machine, const core::ServerInfo& rock, double start_s)
    : reporter_(reporter),
      began_(Clock::now()),
      start_s_(start_s),
      end_s_(end.path_s.value_or(static_cast<double>(end.step) * c.dem.timestep_s)) {
  if (c.machine.kind != cases::MachineKind::shovel) return;
  phases_.emplace(machine::Motion::load(c.machine.motion));
  payload_ = core::channel_index(rock, "mass_in_dipper");
  if (c.machine.drives == machine::DriveMode::limited)
    path_time_ = core::channel_index(machine, "path_time");
}

void Progress::window(const core::Window& w) {
  if (w.step_index == 0) return;
  constexpr int kBar = 6;
  const double t_s = static_cast<double>(w.rock.t_ns) * 1e-9;
  const double along_s = path_time_ ? w.machine.channels[*path_time_] : t_s;
  const double share = std::clamp((t_s - start_s_) / std::max(end_s_ - start_s_, 1e-9), 0.0, 1.0);
  const auto filled = static_cast<std::size_t>(share * kBar);
  const double wall_s = std::chrono::duration<double>(Clock::now() - began_).count();
  const double speed = (t_s - start_s_) / std::max(wall_s, 1e-9);
  const double left_s = speed > 0 ? std::max(0.0, end_s_ - t_s) / speed : 0;
  reporter_.progress(fmt::format("[{}{}] {:.1f}/{:.1f} s{}  {} left  speed {:.3g}",
                                 std::string(filled, '#'), std::string(kBar - filled, '.'), t_s,
                                 end_s_, pass_text(w, along_s), duration(left_s), speed));
}

std::string Progress::pass_text(const core::Window& w, double along_s) const {
  if (!phases_) return "";
  return fmt::format("  {:<11}  payload {:4.1f} t", phases_->at(along_s),
                     w.rock.channels[payload_] * 1e-3);
}

}  // namespace dipper::run
