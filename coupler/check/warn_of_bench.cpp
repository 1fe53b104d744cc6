#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/angles.hpp"
#include "coupler/check/warning_parts.hpp"

namespace dipper::check {
namespace {

constexpr double kSteep_deg = 60;  // as dipper survey: blasted rock rests at 30 to 45
constexpr double kStep = 0.25;     // of the height, at once at the toe

}  // namespace

void warn_of_bench(const cases::Case& c, std::vector<Finding>& warnings) {
  const auto& outline = c.pile.outline_m;
  if (c.pile.profile.empty() || outline.size() < 2) return;
  double top = 0;
  for (const auto& p : outline) top = std::max(top, p.y());
  const auto say = [&](const std::string& what) {
    warnings.push_back({c.pile.profile, 0, "pile.profile", what});
  };
  if (!c.pile.surface && outline.front().y() > kStep * top)
    return say(
        fmt::format("begins with a step of {:.2g} m at the toe, x = {:g} m: is the foot of "
                    "the face missing?",
                    outline.front().y(), outline.front().x()));
  const auto first_above = [&](double share) {
    return std::find_if(outline.begin(), outline.end(),
                        [&](const auto& p) { return p.y() >= share * top; });
  };
  const auto low = first_above(0.25), high = first_above(0.75);
  if (low == outline.end() || high == outline.end() || low == high) return;
  const double angle = degrees(std::atan2(high->y() - low->y(), high->x() - low->x()));
  if (angle > kSteep_deg)
    say(fmt::format(
        "the face stands at {:.0f} degrees, and blasted rock rests at 30 to 45: are the "
        "heights in another unit than x?",
        angle));
}

}  // namespace dipper::check
