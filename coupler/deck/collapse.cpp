#include "coupler/deck/collapse.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/seconds.hpp"
#include "coupler/deck/contact_table.hpp"
#include "coupler/deck/pile_shape.hpp"
#include "machine/door.hpp"

namespace dipper::deck {
namespace {

// Solid fraction when it comes loose: below kPouredFraction, because a thin slab is harder to fill.
constexpr double kLooseFraction = 0.25;
constexpr std::int64_t kSample_ns = 10'000'000;
constexpr double kSteepest = 0.1;  // run by rise: a slab on an upright face needs a slope to lie on

/// The x at which the outline first reaches a height.
double first_at(const cases::BenchOutline& outline, double height_m) {
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Eigen::Vector2d& b = outline[k];
    if (b.y() < height_m) continue;
    if (k == 0) return b.x();
    const Eigen::Vector2d& a = outline[k - 1];
    return a.x() + (b.x() - a.x()) * (height_m - a.y()) / (b.y() - a.y());
  }
  return outline.back().x();
}

}  // namespace

CollapseSlab collapse_slab(const cases::Case& c) {
  const PileShape pile = pile_shape(c);
  const cases::BenchOutline outline = bench_outline(c);
  const double height = c.collapse.height_m, half = pile.height_m / 2;
  double largest = 0;  // a whole rock fits in it
  for (const RockClass& rock : rock_classes(c)) largest = std::max(largest, 2 * rock.radius_m);
  const double loose = height * kSettledFraction / kLooseFraction + largest;

  CollapseSlab s;
  s.rear_x_m = pile.rear_x_m;
  s.crest_x_m = first_at(outline, pile.height_m);
  s.face_x_m = std::min(first_at(outline, half), s.crest_x_m - kSteepest * half);
  const double slope = (s.crest_x_m - s.face_x_m) / half;
  double lift = 0;  // above the parts of a profile in front of the straight face
  for (const Eigen::Vector2d& p : outline) {
    const double straight = half + (p.x() - s.face_x_m) / slope;
    if (p.x() > s.face_x_m) lift = std::max(lift, p.y() - std::min(straight, pile.height_m));
  }
  s.foot_z_m = half + lift;
  s.crest_z_m = pile.height_m + lift;
  s.foot_x_m = s.face_x_m - slope * loose;
  s.top_m = s.crest_z_m + loose;
  s.run_m = slope * (s.top_m - s.foot_z_m);
  s.mass_kg =
      kSettledFraction * laden_density(c) * height * c.pile.width_m * (s.rear_x_m - s.face_x_m);
  return s;
}

std::optional<double> collapse_time_s(const cases::Case& c, const machine::Motion& motion) {
  if (c.collapse.at_s > 0) return c.collapse.at_s;
  for (std::int64_t t = motion.start_ns(); t <= motion.end_ns(); t += kSample_ns) {
    if (machine::door_is_open(motion.value(t).door)) return seconds(t);
  }
  return std::nullopt;
}

std::vector<std::pair<std::string, std::string>> collapse_variables(const CollapseSlab& s) {
  const auto number = [](double v) { return fmt::format("{:.9g}", v); };
  return {{"slab_foot_x", number(s.foot_x_m)},   {"slab_foot_z", number(s.foot_z_m)},
          {"slab_face_x", number(s.face_x_m)},   {"slab_crest_x", number(s.crest_x_m)},
          {"slab_crest_z", number(s.crest_z_m)}, {"slab_top", number(s.top_m)},
          {"slab_run", number(s.run_m)},         {"slab_mass", number(s.mass_kg)}};
}

}  // namespace dipper::deck
