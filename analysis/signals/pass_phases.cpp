#include "analysis/signals/pass_phases.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/signals/time_mean.hpp"

namespace dipper::analysis::signals {
namespace {

bool is_dig(const Phase& p) {
  return p.name >= PhaseName::penetrate && p.name <= PhaseName::breakout;
}

/// Of a pass whose door has not opened: its "dump" is where the house was as far round as it came.
void end_before_dump(std::vector<Phase>& phases) {
  while (phases.size() > 1 && phases.back().name >= PhaseName::dump) {
    phases[phases.size() - 2].t_end_s = phases.back().t_end_s;
    phases.pop_back();
  }
}

/// Of a pass without a swing: the load leaves from where it was dug, and the rest is the dump.
void dump_without_swing(std::vector<Phase>& phases, double t_dump_s) {
  const bool swings = std::any_of(phases.begin(), phases.end(),
                                  [](const Phase& p) { return p.name >= PhaseName::swing; });
  if (swings || phases.empty() || phases.back().t_start_s >= t_dump_s) return;
  const double end_s = phases.back().t_end_s;
  phases.back().t_end_s = t_dump_s;
  phases.emplace_back(PhaseName::dump, t_dump_s, end_s);
}

}  // namespace

const Phase* PassPhases::phase(PhaseName name) const {
  const auto at =
      std::find_if(phases.begin(), phases.end(), [&](const Phase& p) { return p.name == name; });
  return at == phases.end() ? nullptr : &*at;
}

std::optional<TimeSpan> PassPhases::dig() const {
  const auto first = std::find_if(phases.begin(), phases.end(), is_dig);
  const auto last = std::find_if(phases.rbegin(), phases.rend(), is_dig);
  if (first == phases.end()) return std::nullopt;
  return TimeSpan{first->t_start_s, last->t_end_s};
}

double slack_fraction(const PassSignals& s, double t_start_s, double t_end_s) {
  return time_mean(s.time_s, t_start_s, t_end_s,
                   [&](std::size_t i) { return s.rope_tension_N[i] < kSlack_N ? 1.0 : 0.0; })
      .value_or(0);
}

std::vector<PassPhases> find_pass_phases(const PassSignals& s, const DriveSignals& drive) {
  const std::vector<Pass> passes = find_passes(s);
  std::vector<PassPhases> out;
  for (std::size_t k = 0; k < passes.size(); ++k) {
    PassPhases p;
    p.pass = passes[k];
    p.t_end_s = k + 1 < passes.size() ? passes[k].t_end_s : s.time_s.back();
    p.phases = find_phases(drive, p.pass.t_start_s, p.t_end_s);
    if (p.pass.t_dump_s == p.pass.t_end_s)
      end_before_dump(p.phases);
    else
      dump_without_swing(p.phases, p.pass.t_dump_s);
    const bool met_rock = p.pass.t_dig_s < p.pass.t_dump_s;
    if (const auto dig = p.dig(); dig && met_rock) {
      p.dig_phases_force_mean_N = time_mean(
          s.time_s, dig->t_start_s, dig->t_end_s,
          [&](std::size_t i) { return std::hypot(s.crowd_force_N[i], s.hoist_force_N[i]); });
      if (p.dig_phases_force_mean_N)
        p.dig_slack_fraction = slack_fraction(s, dig->t_start_s, dig->t_end_s);
    }
    out.push_back(std::move(p));
  }
  return out;
}

}  // namespace dipper::analysis::signals
