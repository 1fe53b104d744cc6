#include "analysis/signals/observe.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace dipper::analysis::signals {
namespace {

/// The integral, at any time, of a signal that holds value i over (time[i-1], time[i]].
class Integral {
 public:
  Integral(const std::vector<double>& time, const std::vector<double>& value)
      : time_(time), value_(value), sum_(time.size(), 0.0) {
    for (std::size_t i = 1; i < time.size(); ++i) {
      sum_[i] = sum_[i - 1] + value[i] * (time[i] - time[i - 1]);
    }
  }
  double mean(double from, double to) const { return (at(to) - at(from)) / (to - from); }

 private:
  double at(double t) const {
    if (t <= time_.front()) return (t - time_.front()) * value_.front();
    if (t >= time_.back()) return sum_.back() + (t - time_.back()) * value_.back();
    const auto i =
        static_cast<std::size_t>(std::lower_bound(time_.begin(), time_.end(), t) - time_.begin());
    return sum_[i] - (time_[i] - t) * value_[i];
  }
  const std::vector<double>& time_;
  const std::vector<double>& value_;
  std::vector<double> sum_;
};

void add_laws(const Instruments& instruments, const std::vector<TimeSpan>& passes,
              std::vector<LoggedSample>& log) {
  if (instruments.hoist_law.empty() && instruments.crowd_law.empty()) return;
  DriveSignals logged;
  for (const LoggedSample& l : log) {
    logged.time_s.push_back(l.time_s);
    logged.hoist_m.push_back(l.hoist_m);
    logged.crowd_m.push_back(l.crowd_m);
    logged.swing_rad.push_back(l.swing_rad);
  }
  const auto terms = drive_terms(logged, passes);
  for (std::size_t k = 0; k < log.size(); ++k) {
    log[k].hoist_force_kN += force_kN(instruments.hoist_law, terms[k]);
    log[k].crowd_force_kN += force_kN(instruments.crowd_law, terms[k]);
  }
}

}  // namespace

std::vector<LoggedSample> log_signals(const DriveSignals& s, const Instruments& instruments,
                                      const std::vector<TimeSpan>& passes) {
  for (const auto* v : {&s.hoist_m, &s.crowd_m, &s.swing_rad, &s.hoist_force_N, &s.crowd_force_N}) {
    if (v->size() != s.time_s.size()) {
      throw std::invalid_argument("drive signals of different lengths");
    }
  }
  std::vector<LoggedSample> log;
  if (s.time_s.empty()) return log;
  const Integral hoist(s.time_s, s.hoist_m), crowd(s.time_s, s.crowd_m),
      swing(s.time_s, s.swing_rad), hoist_force(s.time_s, s.hoist_force_N),
      crowd_force(s.time_s, s.crowd_force_N);
  const double interval = 1 / instruments.rate_Hz;
  const auto n = static_cast<long>(std::floor(s.time_s.back() / interval + 1e-9));
  for (long k = 1; k <= n; ++k) {
    const double to = static_cast<double>(k) * interval, from = to - interval;
    const double late = instruments.lag_s;
    log.push_back(
        {to, hoist.mean(from, to), crowd.mean(from, to), swing.mean(from, to),
         1e-3 * (1 + instruments.hoist_cell_gain) * hoist_force.mean(from - late, to - late),
         1e-3 * (1 + instruments.crowd_cell_gain) * crowd_force.mean(from - late, to - late)});
  }
  add_laws(instruments, passes, log);
  return log;
}

std::vector<WeighedPass> weigh(const std::vector<Pass>& passes, const Instruments& instruments) {
  std::vector<WeighedPass> out;
  const auto last = std::find_if(passes.rbegin(), passes.rend(),
                                 [](const Pass& p) { return p.dumped && p.truck_kg > 0; });
  for (const Pass& p : passes) {
    if (!p.dumped) continue;
    const double kept = last != passes.rend() && &p == &*last ? 1 - instruments.truck_spillage : 1;
    double mass_t =
        1e-3 * p.truck_kg * (1 - instruments.door_leak) * kept * (1 + instruments.scale_gain);
    if (p.truck_kg > 0) mass_t += instruments.scale_offset_t;
    out.push_back({p.pass, p.t_start_s, p.t_end_s, std::max(0.0, mass_t)});
  }
  return out;
}

}  // namespace dipper::analysis::signals
