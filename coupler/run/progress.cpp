#include "coupler/run/progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "common/seconds.hpp"

namespace dipper::run {
namespace {

// The time left is shown only after this wall time and this fraction of the run: earlier estimates
// are poor.
constexpr double kShownAfter_s = 10, kShownAfter = 0.02;

std::string duration(double s) {
  if (s < 99.5) return fmt::format("{:.0f} s", s);
  if (s < 99.5 * 60) return fmt::format("{:.0f} min", s / 60);
  return fmt::format("{:.1f} h", s / 3600);
}

}  // namespace

Progress::Progress(Reporter& reporter, const cases::Case& c, const RunEnd& end,
                   const core::ServerInfo& machine, const core::ServerInfo& rock,
                   std::function<Clock::time_point()> now)
    : reporter_(reporter),
      now_(std::move(now)),
      end_s_(end.path_s.value_or(static_cast<double>(end.step) * c.dem.timestep_s)),
      by_motion_(end.path_s.has_value()) {
  if (c.machine.kind != cases::MachineKind::shovel) return;
  payload_ = core::channel_index(rock, "mass_in_dipper");
  if (end.program_drives) return;
  if (c.machine.drives == machine::DriveMode::limited)
    path_time_ = core::channel_index(machine, "path_time");
  if (c.machine.operated_by == cases::OperatorKind::motion)
    phases_.emplace(machine::Motion::load(c.machine.motion));
}

void Progress::window(const core::Window& w) {
  if (w.step_index == 0) return;
  constexpr int kBar = 6;
  const double t_s = seconds(w.rock.t_ns);
  const std::optional<Passes> passes = passes_ ? std::optional(passes_()) : std::nullopt;
  const double end_s = passes ? passes->end_s : end_s_;
  const bool by_motion = by_motion_ || passes;
  const double along_s = path_time_ ? w.machine.channels[*path_time_] : t_s;
  const State now = {now_(), t_s, by_motion ? along_s : t_s};
  if (!first_) first_ = now;
  const auto filled =
      static_cast<std::size_t>(std::clamp(now.progress_s / std::max(end_s, 1e-9), 0.0, 1.0) * kBar);
  std::string line =
      fmt::format("[{}{}] {:.1f}{} s", std::string(filled, '#'), std::string(kBar - filled, '.'),
                  t_s, by_motion ? "" : fmt::format("/{:.1f}", end_s));
  if (passes) line += fmt::format("  pass {}", passes->pass);
  if (phases_) line += fmt::format("  {:<11}", phases_->at(along_s));
  if (payload_) line += fmt::format("  payload {:4.1f} t", w.rock.channels[*payload_] * 1e-3);
  const double wall_s = std::chrono::duration<double>(now.wall - first_->wall).count();
  const double done_s = now.progress_s - first_->progress_s,
               left_s = std::max(0.0, end_s - now.progress_s);
  if (wall_s >= kShownAfter_s && done_s >= kShownAfter * (done_s + left_s))
    line += fmt::format("  {} left", duration(left_s * wall_s / done_s));
  if (wall_s > 0) line += fmt::format("  speed {:.3g}", (t_s - first_->t_s) / wall_s);
  reporter_.progress(line);
}

}  // namespace dipper::run
