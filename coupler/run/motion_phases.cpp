#include "coupler/run/motion_phases.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/signals/passes.hpp"
#include "common/seconds.hpp"

namespace dipper::run {
namespace {

constexpr std::int64_t kTick_ns = 50'000'000;

}  // namespace

MotionPhases::MotionPhases(const machine::Motion& motion) {
  namespace signals = analysis::signals;
  signals::DriveSignals drive;
  std::vector<double> door_rad;
  const std::int64_t n = (motion.end_ns() - motion.start_ns() + kTick_ns - 1) / kTick_ns;
  for (std::int64_t i = 0; i <= n; ++i) {
    const std::int64_t t_ns = std::min(motion.start_ns() + i * kTick_ns, motion.end_ns());
    const machine::Drives at = motion.value(t_ns);
    drive.time_s.push_back(seconds(t_ns));
    drive.crowd_m.push_back(at.crowd);
    drive.swing_rad.push_back(at.swing);
    door_rad.push_back(at.door);
  }
  std::vector<signals::PlannedPass> passes = signals::find_planned_passes(drive.time_s, door_rad);
  if (passes.empty()) passes.push_back({drive.time_s.front(), 0});
  passes.back().t_end_s = drive.time_s.back();  // the return belongs to the last pass
  for (std::size_t k = 0; k < passes.size(); ++k)
    for (const signals::Phase& phase :
         signals::find_phases(drive, passes[k].t_start_s, passes[k].t_end_s))
      phases_.push_back({static_cast<int>(k) + 1, phase});
}

std::string MotionPhases::at(double t_s) const {
  const auto after =
      std::upper_bound(phases_.begin(), phases_.end(), t_s,
                       [](double t, const InPass& p) { return t < p.phase.t_start_s; });
  if (after == phases_.begin()) return "";
  return fmt::format("{} {}", (after - 1)->pass, word((after - 1)->phase.name));
}

}  // namespace dipper::run
