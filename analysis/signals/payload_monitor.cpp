#include "analysis/signals/payload_monitor.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "machine/door.hpp"

namespace dipper::analysis::signals {
namespace {

constexpr double kStands_m_s = 0.1;
constexpr double kShortest_s = 0.5;       // if shorter, the drives never stood still
constexpr double kHalf_s = 0.25;          // half of the time over which speeds are taken
constexpr double kLeastFraction = 1e-12;  // of g^2: below, neither balance shows the load

/// The rate of change of a signal at a reading.
double speed_at(const std::vector<double>& time_s, const std::vector<double>& x, std::size_t i) {
  const auto at = [&](double t) {
    const auto it = std::lower_bound(time_s.begin(), time_s.end(), t);
    return std::min(static_cast<std::size_t>(it - time_s.begin()), time_s.size() - 1);
  };
  const std::size_t a = at(time_s[i] - kHalf_s), b = at(time_s[i] + kHalf_s);
  return b > a ? (x[b] - x[a]) / (time_s[b] - time_s[a]) : 0;
}

}  // namespace

std::optional<machine::Holding> PayloadMonitor::holding_of_a_kg(double hoist_m,
                                                                double crowd_m) const {
  try {
    const machine::HandleStatics statics(machine_, rake_);
    const machine::HandlePlace p = statics.at({hoist_m, crowd_m, 0, 0});
    return p.holding(p.of_a_kg());
  } catch (const std::domain_error&) {
    return std::nullopt;
  }
}

std::optional<MonitorReading> PayloadMonitor::weigh(const DriveSignals& s,
                                                    const std::vector<double>& door_rad,
                                                    const PassPhases& pass) const {
  const Phase* swing = pass.phase(PhaseName::swing);
  if (swing == nullptr || !pass.pass.dumped) return std::nullopt;
  const auto& t = s.time_s;
  std::vector<std::size_t> all, still;
  double still_s = 0;
  for (std::size_t i = 1; i < t.size(); ++i) {
    if (t[i] < swing->t_start_s || t[i] > pass.pass.t_dump_s) continue;
    if (!machine::door_is_latched(door_rad[i])) continue;
    all.push_back(i);
    if (std::abs(speed_at(t, s.hoist_m, i)) > kStands_m_s) continue;
    if (std::abs(speed_at(t, s.crowd_m, i)) > kStands_m_s) continue;
    still.push_back(i);
    still_s += t[i] - t[i - 1];
  }
  MonitorReading reading;
  reading.at_rest = still_s >= kShortest_s;
  const machine::HandleStatics statics(machine_, rake_);
  double sum = 0, weight = 0;
  for (const std::size_t i : reading.at_rest ? still : all) {
    try {
      // The drives' forces minus those of the empty dipper, and the forces of one kilogram of load.
      const machine::HandlePlace p = statics.at({s.hoist_m[i], s.crowd_m[i], 0, 0});
      const double turns = speed_at(t, s.swing_rad, i);
      const machine::Burden load =
                                p.held({s.hoist_force_N[i], s.crowd_force_N[i]}) - p.empty(turns),
                            kg = p.of_a_kg(turns);
      const double arm2 = p.arm() * p.arm();
      sum += kg.moment * load.moment / arm2 + kg.along * load.along;
      weight += kg.moment * kg.moment / arm2 + kg.along * kg.along;
      reading.rows.push_back(i);
    } catch (const std::domain_error&) {  // the ropes hang slack: taut ones would not reach
    }
  }
  if (weight <= kLeastFraction) return std::nullopt;
  reading.mass_kg = sum / weight;
  reading.from_s = t[reading.rows.front()];
  reading.to_s = t[reading.rows.back()];
  return reading;
}

}  // namespace dipper::analysis::signals
