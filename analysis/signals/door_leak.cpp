#include "analysis/signals/door_leak.hpp"

#include <algorithm>
#include <stdexcept>

#include "analysis/signals/phases.hpp"

namespace dipper::analysis::signals {

void leak(double share, const PassSignals& s, const std::vector<Pass>& passes,
          const PayloadMonitor& monitor, DriveSignals& drives) {
  if (s.dipper_mass_kg.size() != drives.time_s.size())
    throw std::invalid_argument("signals of a run of different lengths");
  for (const Pass& pass : passes) {
    if (!pass.dumped) continue;
    const std::vector<Phase> phases = find_phases(drives, pass.t_start_s, pass.t_end_s);
    const auto breakout = std::find_if(
        phases.begin(), phases.end(), [](const Phase& p) { return p.name == PhaseName::breakout; });
    if (breakout == phases.end() || breakout->t_start_s >= pass.t_dump_s) continue;
    const double from = breakout->t_start_s, to = pass.t_dump_s;
    for (std::size_t i = 0; i < drives.time_s.size(); ++i) {
      const double t = drives.time_s[i];
      if (t <= from || t > pass.t_end_s) continue;
      const double lost_kg = share * std::min(1.0, (t - from) / (to - from)) * s.dipper_mass_kg[i];
      const auto of_a_kg = monitor.holding_of_a_kg(drives.hoist_m[i], drives.crowd_m[i]);
      if (!of_a_kg) continue;
      drives.hoist_force_N[i] -= lost_kg * of_a_kg->hoist;
      drives.crowd_force_N[i] -= lost_kg * of_a_kg->crowd;
    }
  }
}

}  // namespace dipper::analysis::signals
