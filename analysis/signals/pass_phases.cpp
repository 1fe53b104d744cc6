#include "analysis/signals/pass_phases.hpp"

#include <algorithm>
#include <cmath>

namespace dipper::analysis::signals {
namespace {

bool is_dig(const Phase& p) {
  return p.name == "penetrate" || p.name == "fill" || p.name == "breakout";
}

std::optional<double> dig_force_mean_N(const PassSignals& s, const std::vector<Phase>& phases) {
  const auto first = std::find_if(phases.begin(), phases.end(), is_dig);
  const auto last = std::find_if(phases.rbegin(), phases.rend(), is_dig);
  if (first == phases.end()) return std::nullopt;
  double impulse = 0, time_s = 0;
  for (std::size_t i = 0; i + 1 < s.time_s.size(); ++i) {
    // A step counts with the part of it that is in the dig.
    const double from = std::max(s.time_s[i], first->t_start_s);
    const double to = std::min(s.time_s[i + 1], last->t_end_s);
    if (to <= from) continue;
    impulse += std::hypot(s.crowd_force_N[i], s.hoist_force_N[i]) * (to - from);
    time_s += to - from;
  }
  if (time_s <= 0) return std::nullopt;
  return impulse / time_s;
}

}  // namespace

const Phase* PassPhases::phase(const std::string& name) const {
  const auto at =
      std::find_if(phases.begin(), phases.end(), [&](const Phase& p) { return p.name == name; });
  return at == phases.end() ? nullptr : &*at;
}

std::vector<PassPhases> find_pass_phases(const PassSignals& s, const DriveSignals& drive) {
  const std::vector<Pass> passes = find_passes(s);
  std::vector<PassPhases> out;
  for (std::size_t k = 0; k < passes.size(); ++k) {
    PassPhases p;
    p.pass = passes[k];
    p.t_end_s = k + 1 < passes.size() ? passes[k].t_end_s : s.time_s.back();
    p.phases = find_phases(drive, p.pass.t_start_s, p.t_end_s);
    p.dig_phases_force_mean_N = dig_force_mean_N(s, p.phases);
    out.push_back(std::move(p));
  }
  return out;
}

}  // namespace dipper::analysis::signals
