#include "analysis/signals/phases.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace dipper::analysis::signals {
namespace {

constexpr double kNever = -1;

/// First time, from reading `begin` to before `end`, at which x, linear between readings, is at or
/// past `level`.
double crossing(const std::vector<double>& t, const std::vector<double>& x, std::size_t begin,
                std::size_t end, double level, bool rising) {
  const auto past = [&](std::size_t i) { return rising ? x[i] >= level : x[i] <= level; };
  std::size_t k = begin;
  while (k < end && !past(k)) ++k;
  if (k == end) return kNever;
  if (k == begin) return t[k];
  return t[k - 1] + (t[k] - t[k - 1]) * (level - x[k - 1]) / (x[k] - x[k - 1]);
}

struct Readings {
  std::vector<double> t, crowd, swing;

  /// The first reading with the crowd nearly all out in the dig: the crowd's longest way out while
  /// the house holds its heading. Over the truck the crowd may be further out.
  std::size_t out(const PhaseRules& rules) const {
    const auto [left, right] = std::minmax_element(swing.begin(), swing.end());
    const double range = *right - *left;
    const double turned = range > rules.least_swing_rad ? rules.swing_from * range : range;
    std::size_t in = 0, dig_in = 0, dig_out = 0;
    for (std::size_t i = 0; i < crowd.size(); ++i) {
      if (crowd[i] < crowd[in] || std::abs(swing[i] - swing[in]) > turned) in = i;
      if (crowd[i] - crowd[in] > crowd[dig_out] - crowd[dig_in]) dig_in = in, dig_out = i;
    }
    const double nearly = crowd[dig_in] + rules.breakout_from * (crowd[dig_out] - crowd[dig_in]);
    std::size_t i = dig_in;
    while (crowd[i] < nearly) ++i;
    return i;
  }
};

Readings in_pass(const DriveSignals& s, double t_start_s, double t_end_s) {
  if (s.crowd_m.size() != s.time_s.size() || s.swing_rad.size() != s.time_s.size())
    throw std::invalid_argument("drive signals of different lengths");
  Readings r;
  for (std::size_t i = 0; i < s.time_s.size(); ++i) {
    if (s.time_s[i] < t_start_s || s.time_s[i] > t_end_s) continue;
    r.t.push_back(s.time_s[i]);
    r.crowd.push_back(s.crowd_m[i]);
    r.swing.push_back(s.swing_rad[i]);
  }
  if (r.t.size() < 2) throw std::invalid_argument("fewer than two readings in a pass");
  return r;
}

}  // namespace

double dig_heading_rad(const DriveSignals& s, double t_start_s, double t_end_s,
                       const PhaseRules& rules) {
  const Readings r = in_pass(s, t_start_s, t_end_s);
  return r.swing[r.out(rules)];
}

std::vector<Phase> find_phases(const DriveSignals& s, double t_start_s, double t_end_s,
                               const PhaseRules& rules) {
  const Readings readings = in_pass(s, t_start_s, t_end_s);
  auto [t, crowd, turned] = readings;
  // The shovel faces the rock at the heading at which it digs. A pass may begin
  // while the house still swings back, and may end at another heading.
  const std::size_t n = t.size();
  const std::size_t out = readings.out(rules);
  const double heading = turned[out];
  for (double& a : turned) a = std::abs(a - heading);
  const double swing = *std::max_element(turned.begin() + static_cast<long>(out), turned.end());
  const bool swings = swing > rules.least_swing_rad;
  const auto faces = [&](std::size_t i) {
    return !swings || turned[i] <= rules.swing_from * swing;
  };

  // The dig: while the shovel faces the rock. Its stroke is from the least crowd value to the
  // largest after it.
  std::size_t begin = out, dug = out;
  while (begin > 0 && faces(begin - 1)) --begin;
  while (dug < n && faces(dug)) ++dug;
  const auto from_here = crowd.begin() + static_cast<long>(begin);
  const auto furthest = std::max_element(from_here, crowd.begin() + static_cast<long>(dug));
  const auto in = std::min_element(from_here, furthest + 1);
  const auto start = static_cast<std::size_t>(in - crowd.begin());
  const double stroke = *furthest - *in;
  const auto at_stroke = [&](double share) {
    return crossing(t, crowd, start, dug, *in + share * stroke, true);
  };
  double arrive = kNever, depart = kNever, leave_dig = kNever;
  if (swings) {
    leave_dig = crossing(t, turned, out, n, rules.swing_from * swing, true);
    arrive = crossing(t, turned, out, n, rules.dump_from * swing, true);
    std::size_t there = out;
    while (turned[there] <= rules.dump_from * swing) ++there;
    depart = crossing(t, turned, there, n, rules.dump_from * swing, false);
  }
  const std::array<double, 6> marks = {at_stroke(rules.penetrate_from),
                                       at_stroke(rules.fill_from),
                                       at_stroke(rules.breakout_from),
                                       leave_dig,
                                       arrive,
                                       depart};
  std::vector<Phase> phases;
  double from = t.front();
  for (std::size_t k = 0; k < kPhaseWords.size(); ++k) {
    double end = k < marks.size() && marks[k] != kNever ? marks[k] : t.back();
    end = std::max(end, from);
    if (end - from > 1e-9) phases.emplace_back(static_cast<PhaseName>(k), from, end);
    from = end;
  }
  return phases;
}

}  // namespace dipper::analysis::signals
