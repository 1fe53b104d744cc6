#include "machine/pass_motion.hpp"

#include <algorithm>
#include <cmath>

#include "machine/motion_row.hpp"

namespace dipper::machine {
namespace {

constexpr double kShortestTurn_s = 2;

/// A move, later, and as much longer.
Move later(const Move& m, double by_s, double factor = 1) {
  const double start = m.start_s + by_s;
  return {start, start + factor * (m.end_s - m.start_s), factor * m.ramp_s};
}

/// The pass, laid out from its start at 0 s.
struct Layout {
  TeethPath back, out;
  Move back_move, swing_back, door_close, dig, swing_out, door_open;
  double end_s = 0;
};

Layout lay_out(const MotionPlan& p, const PlannedPass& pass, double teeth_m_s, double over_m,
               const PassStart& from, const ShovelKinematics& shovel) {
  Layout l;
  const double full_turn = std::abs(p.dump_rad);  // of the plan's swings
  const auto turn = [&](double a, double b) {
    return full_turn > 0 ? std::abs(a - b) / full_turn : 1;
  };
  double face_s = 0;  // when it is in front of the face
  if (from.at_dump) {
    const double first = std::min({p.back.start_s, p.swing_back.start_s, p.door_close.start_s});
    TeethPath back(1, p.lift.back());
    for (const Vector2d& q : p.lower)  // down to where the dig begins
      if (q.y() > pass.dig.front().y()) back.push_back(q);
    back.push_back(pass.dig.front());
    l.back = spline(back);
    l.back_move = later(p.back, -first);
    l.swing_back = later(p.swing_back, -first, turn(p.dump_rad, pass.heading_rad));
    l.door_close = later(p.door_close, -first);
    face_s = std::max({l.back_move.end_s, l.swing_back.end_s, l.door_close.end_s});
  } else {
    l.back = {from.tip, pass.dig.front()};
    const double share = turn(from.heading_rad, pass.heading_rad);
    const bool moves = share > 0 || (from.tip - pass.dig.front()).norm() > 1e-3;
    face_s =
        moves ? std::max(kShortestTurn_s, share * (p.swing_out.end_s - p.swing_out.start_s)) : 0;
    l.back_move = l.swing_back = {0, std::max(face_s, 1e-3), 0.25 * face_s};
  }
  TeethPath out = pass.dig;
  out.insert(out.end(), p.lift.begin(), p.lift.end());
  l.out = spline(out);
  const double dig_start = face_s + p.dig.start_s;
  l.dig = {dig_start, dig_start + length(l.out) / teeth_m_s + p.dig.ramp_s, p.dig.ramp_s};

  // Over everything: teeth and heel, on the way out.
  double clear = 1;
  for (std::size_t k = l.out.size(); k-- > 0;) {
    if (std::min(l.out[k].y(), shovel.heel(l.out[k]).y()) < over_m) break;
    clear = static_cast<double>(k) / static_cast<double>(l.out.size() - 1);
  }
  double clear_s = l.dig.end_s;
  for (double t = l.dig.start_s; t < l.dig.end_s; t += 0.05)
    if (l.dig.share(t) >= clear) {
      clear_s = t;
      break;
    }
  l.swing_out =
      later(p.swing_out, clear_s - p.swing_out.start_s, turn(p.dump_rad, pass.heading_rad));
  const double wait = std::max(0.0, p.door_open.start_s - p.swing_out.end_s);
  const double over_truck = std::max(l.swing_out.end_s, l.dig.end_s) + wait;
  l.door_open = later(p.door_open, over_truck - p.door_open.start_s);
  const double leave = p.returns
                           ? std::min({p.back.start_s, p.swing_back.start_s, p.door_close.start_s})
                           : p.cycle_s;
  const double empty_s = l.door_open.end_s + std::max(0.0, leave - p.door_open.end_s);
  l.end_s = p.sample_s * std::ceil(empty_s / p.sample_s - 1e-9);  // the last row's
  return l;
}

}  // namespace

PassTimes pass_times(const MotionPlan& cycle, const PlannedPass& pass, double teeth_m_s,
                     double over_m, const PassStart& from, const ShovelKinematics& shovel) {
  const Layout l = lay_out(cycle, pass, teeth_m_s, over_m, from, shovel);
  return {from.t_s + l.dig.start_s, from.t_s + l.door_open.start_s, from.t_s + l.end_s};
}

std::string pass_rows(const MotionPlan& cycle, const PlannedPass& pass, double teeth_m_s,
                      double over_m, const PassStart& from, const ShovelKinematics& shovel) {
  const Layout l = lay_out(cycle, pass, teeth_m_s, over_m, from, shovel);
  const double heading0 = from.at_dump ? cycle.dump_rad : from.heading_rad;
  std::string rows;
  const int n = static_cast<int>(std::lround(l.end_s / cycle.sample_s));
  for (int i = 0; i <= n; ++i) {
    const double t = i * cycle.sample_s;
    const Vector2d tip = t < l.dig.start_s ? at_fraction(l.back, l.back_move.share(t))
                                           : at_fraction(l.out, l.dig.share(t));
    const double swing = heading0 + (pass.heading_rad - heading0) * l.swing_back.share(t) +
                         (cycle.dump_rad - pass.heading_rad) * l.swing_out.share(t);
    double door = cycle.door_rad * l.door_open.share(t);
    if (from.at_dump) door += cycle.door_rad * (1 - l.door_close.share(t));
    rows += motion_row(from.t_s + t, tip, swing, door, shovel);
  }
  return rows;
}

}  // namespace dipper::machine
