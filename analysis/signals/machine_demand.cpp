#include "analysis/signals/machine_demand.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "analysis/signals/time_mean.hpp"

namespace dipper::analysis::signals {
namespace {

double share_beyond(const std::vector<double>& time_s, const std::vector<double>& force_N,
                    double limit_N, double t_start_s, double t_end_s) {
  return time_mean(time_s, t_start_s, t_end_s,
                   [&](std::size_t i) { return std::abs(force_N[i]) > limit_N ? 1.0 : 0.0; })
      .value_or(0);
}

}  // namespace

MachineDemand::MachineDemand(const machine::MachineData& machine, double rake,
                             std::vector<double> saddle_rad)
    : drives_(machine.drives), taut_(machine, Pose{}, rake), saddle_rad_(std::move(saddle_rad)) {}

double MachineDemand::teeth_off_m(const DriveSignals& s, std::size_t i) const {
  try {
    const double turn = saddle_rad_[i] - taut_.saddle_angle(s.hoist_m[i], s.crowd_m[i]);
    return std::abs(turn) * taut_.teeth_reach(s.crowd_m[i]);
  } catch (const std::domain_error&) {  // no taut rope is this long
    return 0;
  }
}

Demand MachineDemand::over(const DriveSignals& s, const std::vector<double>& rope_tension_N,
                           double t_start_s, double t_end_s) const {
  Demand d;
  d.hoist_beyond_fraction =
      share_beyond(s.time_s, rope_tension_N, drives_.hoist.stall, t_start_s, t_end_s);
  d.crowd_beyond_fraction =
      share_beyond(s.time_s, s.crowd_force_N, drives_.crowd.stall, t_start_s, t_end_s);
  // While a run writes its record, one dataset may have more rows than another.
  for (std::size_t i = 0; i < std::min(s.time_s.size(), saddle_rad_.size()); ++i)
    if (s.time_s[i] >= t_start_s && s.time_s[i] <= t_end_s)
      d.teeth_deviation_m = std::max(d.teeth_deviation_m, teeth_off_m(s, i));
  return d;
}

}  // namespace dipper::analysis::signals
