#include "machine/pass_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>

#include "common/angles.hpp"
#include "machine/approach.hpp"
#include "machine/cut_ahead.hpp"
#include "machine/handle_statics.hpp"
#include "machine/motion_row.hpp"

namespace dipper::machine {
namespace {

constexpr double kStep_m = 0.15;     // along the path of the teeth
constexpr double kMean_m = 1;        // of the path, over which a force is averaged
constexpr double kBeside_m = 0.1;    // between dipper and side wall
constexpr double kSide_m = 1;        // of the height map beyond the bench
constexpr double kMostOverload = 2;  // of a drive; from 1 on the dig is slower and loads less
constexpr double kOver_m = 0.5;      // between the dipper and the rock that it turns over
constexpr double kScatter = 0.15;    // of one pass's load, standard deviation (docs/operator.md)
constexpr double kHeaped = 1.05;     // of the struck volume; measured: 1.01, at most 1.17

/// The mean of what a dipper holds of a load that scatters normally about `mean`: what is beyond
/// its capacity is left in the face.
double held_kg(double mean, double capacity_kg) {
  if (mean <= 0) return 0;
  const double deviation = kScatter * mean, beyond = mean - capacity_kg, z = beyond / deviation;
  const double above = 0.5 * std::erfc(-z / std::sqrt(2.0)),
               density = std::exp(-0.5 * z * z) / std::sqrt(2 * M_PI);
  return mean - beyond * above - deviation * density;
}

/// The largest mean over kMean_m of the path.
class PeakMean {
 public:
  void add(double value) {
    values_.push_back(value);
    const auto n = static_cast<std::size_t>(std::lround(kMean_m / kStep_m));
    sum_ += value;
    if (values_.size() > n) sum_ -= values_[values_.size() - 1 - n];
    if (values_.size() >= n) peak_ = std::max(peak_, sum_ / static_cast<double>(n));
  }
  double peak() const { return peak_; }

 private:
  std::vector<double> values_;
  double sum_ = 0, peak_ = 0;
};

class DigEvaluator {
 public:
  DigEvaluator(const HeightMap& face, const DigChoice& choice, const MotionPlan& cycle,
               const DigFacts& facts, const MachineData& machine, const ShovelKinematics& shovel,
               const HandleStatics& statics, const Vector3d& base_m, const DigExperience& before)
      : face_(face),
        before_(before),
        choice_(choice),
        cycle_(cycle),
        facts_(facts),
        m_(machine),
        shovel_(shovel),
        base_m_(base_m),
        statics_(statics),
        rock_over_m_(rock_over_m(face)) {}

  void evaluate(DigCandidate& c) const {
    Pose X_WBoom;
    X_WBoom.R = from_rotation_vector({0, 0, c.heading_rad});
    X_WBoom.p = {base_m_.x(), base_m_.y(), 0};
    try {
      const TeethPath profile = face_.profile(X_WBoom, m_.dipper.inside.y() / 2);
      if (profile.size() < 3) throw std::invalid_argument("there is no face at this heading");
      Cut cut;
      cut.start = choice_.start;
      cut.begin = begin(X_WBoom);
      cut.depth_m = c.depth_m;
      cut.floor_rise = c.floor_rise;
      cut.exit_z_m = c.exit_z_m;
      cut.smooth_m = choice_.smooth_m;
      const Vector2d saddle(m_.saddle.position.x(), m_.saddle.position.z());
      c.dig = cut_path(profile, cut, saddle, shovel_.teeth_reach(choice_.crowd_max_m),
                       [&](const Vector2d& tip) { return shovel_.heel(tip); });
      follow_path(c);
    } catch (const std::invalid_argument& e) {
      c.refused = e.what();
    } catch (const std::domain_error& e) {
      c.refused = e.what();
    }
  }

 private:
  /// Where the dig begins: as far down as the rock leaves room.
  Vector2d begin(const Pose& X_WBoom) const {
    if (cycle_.lower.empty()) return choice_.start;
    TeethPath down = cycle_.lower;
    down.push_back(choice_.start);
    return approach_end(spline(down), face_, X_WBoom, m_.dipper.inside.y() / 2, shovel_);
  }

  void follow_path(DigCandidate& c) const {
    TeethPath polygon = c.dig;
    polygon.insert(polygon.end(), cycle_.lift.begin(), cycle_.lift.end());
    const TeethPath path = spline(polygon);
    const double whole = length(path);
    const int n = static_cast<int>(std::ceil(whole / kStep_m));
    const double ds = whole / n;
    HeightMap left = face_;
    const Vector3d half = m_.dipper.inside / 2;
    const Vector3d tip_B = Vector3d(m_.dipper.inside.x() + m_.dipper.tooth_reach, 0, -half.z());
    const Vector3d lip_left_B = tip_B + Vector3d(0, half.y(), 0),
                   lip_right_B = tip_B - Vector3d(0, half.y(), 0);
    PeakMean crowd_peak, hoist_peak;
    double force_sum = 0, force_s = 0, lift_s = 0, crowd_sum = 0, rock_m = 0;
    Pose before;
    Drives at_before;
    for (int k = 0; k <= n; ++k) {
      const Vector2d tip = at_fraction(path, static_cast<double>(k) / n);
      Drives d = shovel_.teeth_at(tip);
      d.swing = c.heading_rad;
      require_within_limits(d);
      const ShovelPose X = shovel_.pose(d);
      require_beside_walls(X.X_WB, lip_left_B, lip_right_B);
      if (k > 0) {
        c.swept_m3 += left.cut(before * lip_left_B, before * lip_right_B, X.X_WB * lip_left_B,
                               X.X_WB * lip_right_B);
        const double load_kg = std::min(facts_.capacity_kg, loaded_kg(c.swept_m3));
        const Vector3d moved = (X.X_WB * tip_B - before * tip_B) / ds;  // at 1 m/s
        const CutAhead ahead = cut_ahead(left, X.X_WB, lip_left_B, lip_right_B, moved);
        const double resistance = ahead.meets ? before_.resistance * facts_.specific_resistance_Pa *
                                                    ahead.depth_m * 2 * half.y()
                                              : 0;
        const HandlePlace place = statics_.at(d);
        const Holding f = place.holding(place.empty() + load_kg * place.of_a_kg() +
                                        resistance * place.of_a_newton());
        const double lifted = (at_before.hoist - d.hoist) / ds,
                     crowded = (d.crowd - at_before.crowd) / ds;  // m of drive by m of path
        const double speed = teeth_speed(f, lifted, crowded);
        const bool in_rock = ahead.depth_m > 0;
        if (in_rock) {
          crowd_peak.add(f.crowd);
          hoist_peak.add(f.hoist);
          force_sum += std::hypot(f.crowd, f.hoist) * ds / speed;
          force_s += ds / speed;
          crowd_sum += f.crowd * ds;
          if (rock_m == 0) c.rock_from_m = (k - 1) * ds;
          c.rock_to_m = k * ds;
          rock_m += ds;
        }
        lift_s += ds / speed;
        c.energy_J += ds * (std::max(0.0, f.hoist * lifted) + std::max(0.0, f.crowd * crowded));
      }
      before = X.X_WB;
      at_before = d;
    }
    c.crowd_peak_N = crowd_peak.peak();
    c.hoist_peak_N = hoist_peak.peak();
    c.dig_s = force_s;
    c.dig_force_mean_N = force_s > 0 ? force_sum / force_s : 0;
    c.crowd_mean_N = rock_m > 0 ? crowd_sum / rock_m : 0;
    c.loose_kg = loaded_kg(c.swept_m3);
    PassStart from;
    from.at_dump = cycle_.returns;
    from.tip = c.dig.front();
    from.heading_rad = c.heading_rad;
    const PassTimes t =
        pass_times(cycle_, {c.dig, c.heading_rad}, choice_.teeth_m_s, rock_over_m_, from, shovel_);
    // Slower than planned where the drives' power asks for it.
    c.cycle_s = t.end_s + std::max(0.0, lift_s - whole / choice_.teeth_m_s);
    const auto& drives = m_.drives;
    c.overload = std::max(c.crowd_peak_N / drives.crowd.stall, c.hoist_peak_N / drives.hoist.stall);
    if (c.overload > 1) c.loose_kg /= c.overload;
    c.payload_kg = held_kg(c.loose_kg, kHeaped * facts_.capacity_kg);
    if (c.crowd_peak_N > kMostOverload * drives.crowd.stall)
      c.refused = fmt::format("the crowd needs {:.2f} MN and has {:.2f}", c.crowd_peak_N * 1e-6,
                              drives.crowd.stall * 1e-6);
    else if (c.hoist_peak_N > kMostOverload * drives.hoist.stall)
      c.refused = fmt::format("the hoist needs {:.2f} MN and has {:.2f}", c.hoist_peak_N * 1e-6,
                              drives.hoist.stall * 1e-6);
  }

  double loaded_kg(double swept_m3) const {
    return before_.loaded * facts_.bulk_density_kg_m3 * swept_m3;
  }

  /// The speed of the teeth that the drives' speeds and powers allow, up to the planned one, m/s.
  double teeth_speed(const Holding& f, double lifted, double crowded) const {
    double v = choice_.teeth_m_s;
    const auto within = [&](double by_path, double most_m_s, double force, double power) {
      if (std::abs(by_path) > 1e-6) v = std::min(v, most_m_s / std::abs(by_path));
      if (force * by_path > 1) v = std::min(v, power / (force * by_path));
    };
    within(lifted, m_.limits.hoist_speed, f.hoist, m_.drives.hoist.power);
    within(crowded, m_.limits.crowd_speed, f.crowd, m_.drives.crowd.power);
    return v;
  }

  void require_within_limits(const Drives& d) const {
    const auto& l = m_.limits;
    if (d.crowd < l.crowd_min || d.crowd > l.crowd_max)
      throw std::domain_error(fmt::format("the crowd would be at {:.2f} m", d.crowd));
    if (d.hoist < l.hoist_min || d.hoist > l.hoist_max)
      throw std::domain_error(fmt::format("the hoist would be at {:.2f} m", d.hoist));
  }

  void require_beside_walls(const Pose& X_WB, const Vector3d& left_B,
                            const Vector3d& right_B) const {
    for (const Vector3d& p : {Vector3d(X_WB * left_B), Vector3d(X_WB * right_B)})
      if (p.x() > facts_.walls_from_x_m && p.z() < rock_over_m_ &&
          std::abs(p.y()) > facts_.half_width_m - kBeside_m)
        throw std::domain_error("the dipper would meet the side of the bench");
  }

  const HeightMap& face_;
  DigExperience before_;
  const DigChoice& choice_;
  const MotionPlan& cycle_;
  const DigFacts& facts_;
  const MachineData& m_;
  const ShovelKinematics& shovel_;
  Vector3d base_m_;
  const HandleStatics& statics_;
  double rock_over_m_;
};

/// The commonest reason for a refusal, with its first candidate; texts are of one kind up to their
/// first number.
std::string most_refused(const std::vector<DigCandidate>& candidates) {
  std::map<std::string, std::vector<const DigCandidate*>> kinds;
  for (const DigCandidate& c : candidates)
    if (!c.refused.empty())
      kinds[c.refused.substr(0, c.refused.find_first_of("0123456789"))].push_back(&c);
  if (kinds.empty()) return "";
  const auto& most = std::max_element(kinds.begin(), kinds.end(), [](auto& a, auto& b) {
                       return a.second.size() < b.second.size();
                     })->second;
  return fmt::format("; {} refused, as heading {:.0f} deg, depth {:.2f} m: {}", most.size(),
                     degrees(most[0]->heading_rad), most[0]->depth_m, most[0]->refused);
}

std::string reason(const DigDecision& decision, DigGoal goal, double least_kg) {
  int diggable = 0;
  double most_kg = 0;
  for (const DigCandidate& c : decision.candidates) {
    if (!c.refused.empty()) continue;
    ++diggable;
    most_kg = std::max(most_kg, c.payload_kg);
  }
  const std::string refused = most_refused(decision.candidates);
  if (decision.chosen < 0)
    return fmt::format(
        "no dig pays: {} of {} digs are feasible, and the best is expected to load {:.0f} t; the "
        "least is {:.0f} t{}",
        diggable, decision.candidates.size(), most_kg * 1e-3, least_kg * 1e-3, refused);
  const DigCandidate& c = decision.candidates[static_cast<std::size_t>(decision.chosen)];
  const bool time = goal == DigGoal::time;
  return fmt::format(
      "{} of {} digs are feasible; the one with most payload per {} ({:.4g} {}) is chosen: heading "
      "{:.0f} deg, depth {:.2f} m, floor rise {:.2f}, exit at {:.1f} m; expected: {:.0f} t, crowd "
      "at most {:.2f} MN, hoist at most {:.2f} MN{}{}",
      diggable, decision.candidates.size(), time ? "time" : "energy", c.score * (time ? 1 : 1e3),
      time ? "kg/s" : "kg/kJ", degrees(c.heading_rad), c.depth_m, c.floor_rise, c.exit_z_m,
      c.payload_kg * 1e-3, c.crowd_peak_N * 1e-6, c.hoist_peak_N * 1e-6,
      c.overload > 1 ? "; a drive is at its limit, so the dig is slower and loads less than planned"
                     : "",
      refused);
}

}  // namespace

double rock_over_m(const HeightMap& face) {
  return kOver_m + *std::max_element(face.heights().begin(), face.heights().end());
}

DigPlanner::DigPlanner(const DigChoice& choice, const MotionPlan& cycle, const DigFacts& facts,
                       const MachineData& machine, const Vector3d& base_m, double rake,
                       DigGoal goal)
    : choice_(choice),
      cycle_(cycle),
      facts_(facts),
      machine_(machine),
      base_m_(base_m),
      shovel_(machine, {Quaterniond::Identity(), base_m}, rake),
      statics_(machine, rake, facts.load_B),
      goal_(goal) {}

PassStart DigPlanner::start() const {
  PassStart s;
  s.tip = choice_.start;
  return s;
}

HeightGrid DigPlanner::grid() const {
  const double reach = machine_.saddle.position.x() + shovel_.teeth_reach(choice_.crowd_max_m);
  const double half = facts_.half_width_m + kSide_m;
  const double heel = base_m_.x() + shovel_.heel(choice_.start).x();
  const double from = std::min(facts_.walls_from_x_m, heel) - kSide_m;
  return face_grid(from, base_m_.x() + reach + kSide_m, -half, half);
}

/// The best first, until one is found whose motion the machine can follow.
void DigPlanner::choose(DigDecision& decision, const HeightMap& face, const PassStart& from,
                        double least_kg) const {
  const auto worth = [&](const DigCandidate& c) {
    return c.refused.empty() && c.payload_kg >= least_kg ? c.score : -1.0;
  };
  while (true) {
    const auto best = std::max_element(
        decision.candidates.begin(), decision.candidates.end(),
        [&](const DigCandidate& a, const DigCandidate& b) { return worth(a) < worth(b); });
    if (best == decision.candidates.end() || worth(*best) < 0) return;
    const PlannedPass pass{best->dig, best->heading_rad};
    const double over_m = rock_over_m(face);
    const std::string rows = pass_rows(cycle_, pass, choice_.teeth_m_s, over_m, from, shovel_);
    const auto beyond = shovel_.check(Motion::parse(kMotionHead + rows, "the pass"));
    if (!beyond.empty()) {
      best->refused = beyond.front();
      continue;
    }
    decision.chosen = static_cast<int>(best - decision.candidates.begin());
    decision.rows = rows;
    decision.times = pass_times(cycle_, pass, choice_.teeth_m_s, over_m, from, shovel_);
    const double set_off_s = decision.times.dig_s + cycle_.dig.ramp_s / 2;
    decision.rock_from_s = set_off_s + best->rock_from_m / choice_.teeth_m_s;
    decision.rock_to_s = set_off_s + best->rock_to_m / choice_.teeth_m_s;
    return;
  }
}

DigDecision DigPlanner::decide(const HeightMap& face, const PassStart& from, double least_kg,
                               double most_kg, const DigExperience& before) const {
  const DigEvaluator evaluator(face, choice_, cycle_, facts_, machine_, shovel_, statics_, base_m_,
                               before);
  DigDecision decision;
  for (const double heading : choice_.heading_rad)
    for (const double depth : choice_.depth_m)
      for (const double rise : choice_.floor_rise)
        for (const double exit_z : choice_.exit_z_m) {
          DigCandidate c;
          c.heading_rad = heading;
          c.depth_m = depth;
          c.floor_rise = rise;
          c.exit_z_m = exit_z;
          evaluator.evaluate(c);
          decision.candidates.push_back(std::move(c));
        }
  const auto score = [&](DigCandidate& c) {
    // Loads scatter: a dig that just fills the truck in the mean fills it in half of the cases.
    const double counts = held_kg(c.loose_kg, std::min(kHeaped * facts_.capacity_kg, most_kg));
    c.score = goal_ == DigGoal::time ? counts / c.cycle_s : counts / c.energy_J;
  };
  for (DigCandidate& c : decision.candidates)
    if (c.refused.empty()) score(c);
  choose(decision, face, from, least_kg);
  decision.reason = reason(decision, goal_, least_kg);
  return decision;
}

}  // namespace dipper::machine
