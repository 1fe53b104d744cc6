#include "mbs/dig_rules.hpp"

#include <algorithm>

namespace dipper::mbs {
namespace {

constexpr double kCarried = 0.5;  // of the empty dipper's moment
constexpr double kFree_m_s = 0.3;
constexpr double kWaits = 0.25;
constexpr double kBreakOut_m_s = 0.3;
constexpr double kLight = 0.9;  // of what the dipper takes
constexpr double kDeeper_m_s = 0.2;
constexpr double kEases_m_s = 0.5;
constexpr double kHeld = 0.9;          // overload that the crowd is held at
constexpr double kGain_m_s = 2.5;      // m/s by overload
constexpr double kMeets = 0.05;        // of the crowd's stall force
constexpr double kSteepest = -0.7071;  // sine of the handle's angle
constexpr double kRoom_m = 0.1;        // to the crowd's stop

}  // namespace

DigWish dig_wish(const DigFeel& f, const DigLimits& limits) {
  DigWish wish;
  if (!f.at_face) return wish;
  if (f.carried < kCarried) {
    wish.rate = kWaits;
    wish.crowd_back = wish.lift = kFree_m_s;
    return wish;
  }
  if (!f.raises) return wish;
  const bool meets = f.resistance_N > kMeets * limits.crowd_stall_N;
  const double held = std::clamp(kGain_m_s * (f.overload - kHeld), -kDeeper_m_s, kEases_m_s);
  const bool may_go_deeper =
      f.load_kg < kLight * limits.full_kg && f.handle_rise > kSteepest && f.room_m > kRoom_m;
  if (f.load_kg >= limits.full_kg)
    wish.crowd_back = meets ? std::max(held, kBreakOut_m_s) : 0.0;
  else if (meets && (held > 0 || may_go_deeper))
    wish.crowd_back = held;
  return wish;
}

}  // namespace dipper::mbs
