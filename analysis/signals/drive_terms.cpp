#include "analysis/signals/drive_terms.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace dipper::analysis::signals {
namespace {

constexpr double kStandsDrive_m_s = 0.05,
                 kStandsHouse_rad_s = 0.02;  // below this speed a drive counts as at rest

/// The slope between the neighbours of each reading.
std::vector<double> speeds(const std::vector<double>& t, const std::vector<double>& x) {
  std::vector<double> v(x.size(), 0.0);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const std::size_t a = i == 0 ? 0 : i - 1, b = std::min(i + 1, x.size() - 1);
    if (t[b] > t[a]) v[i] = (x[b] - x[a]) / (t[b] - t[a]);
  }
  return v;
}

std::size_t index_of(const std::string& name) {
  return static_cast<std::size_t>(std::find(kDriveTerms.begin(), kDriveTerms.end(), name) -
                                  kDriveTerms.begin());
}

/// From the start of breakout to the start of dump; empty where a pass has no such phases.
TimeSpan carried(const std::vector<Phase>& phases) {
  TimeSpan span;
  for (const Phase& p : phases) {
    if (p.name == PhaseName::breakout) span.t_start_s = p.t_start_s;
    if (p.name == PhaseName::dump) span.t_end_s = p.t_start_s;
  }
  return span;
}

}  // namespace

bool is_drive_term(const std::string& name) { return index_of(name) < kDriveTerms.size(); }

std::vector<std::array<double, kDriveTerms.size()>> drive_terms(
    const DriveSignals& s, const std::vector<TimeSpan>& passes) {
  for (const auto* x : {&s.hoist_m, &s.crowd_m, &s.swing_rad})
    if (x->size() != s.time_s.size())
      throw std::invalid_argument("drive signals of different lengths");
  std::vector<std::array<double, kDriveTerms.size()>> rows(s.time_s.size());
  if (rows.empty()) return rows;
  std::vector<TimeSpan> loads;
  for (const TimeSpan& p : passes) loads.push_back(carried(find_phases(s, p.t_start_s, p.t_end_s)));
  const auto hoist = speeds(s.time_s, s.hoist_m), crowd = speeds(s.time_s, s.crowd_m),
             swing = speeds(s.time_s, s.swing_rad);
  const double innermost = *std::min_element(s.crowd_m.begin(), s.crowd_m.end());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double t = s.time_s[i], in = -hoist[i], out = s.crowd_m[i] - innermost;
    const bool reaches = crowd[i] > kStandsDrive_m_s, retracts = crowd[i] < -kStandsDrive_m_s;
    std::size_t pass = 1;
    while (pass < passes.size() && t > passes[pass].t_start_s) ++pass;
    const bool loaded =
        !loads.empty() && t >= loads[pass - 1].t_start_s && t < loads[pass - 1].t_end_s;
    rows[i] = {1.0,
               in > kStandsDrive_m_s ? 1.0 : 0.0,
               in < -kStandsDrive_m_s ? 1.0 : 0.0,
               reaches ? 1.0 : 0.0,
               retracts ? 1.0 : 0.0,
               std::abs(swing[i]) > kStandsHouse_rad_s ? 1.0 : 0.0,
               loaded ? 1.0 : 0.0,
               in,
               crowd[i],
               s.hoist_m[i],
               out,
               reaches    ? out
               : retracts ? -out
                          : 0.0,
               s.swing_rad[i],
               static_cast<double>(pass)};
  }
  return rows;
}

double force_kN(const ForceLaw& law, const std::array<double, kDriveTerms.size()>& terms) {
  double sum = 0;
  for (const auto& [name, number] : law) {
    if (!is_drive_term(name)) throw std::invalid_argument(name + " is not a term of the motion");
    sum += number * terms[index_of(name)];
  }
  return sum;
}

}  // namespace dipper::analysis::signals
