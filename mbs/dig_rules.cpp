#include "mbs/dig_rules.hpp"

#include <algorithm>

namespace dipper::mbs {
namespace {

constexpr double kCarried = 0.5;  // of the empty dipper's moment
constexpr double kFree_m_s = 0.3;
constexpr double kWaits = 0.25;
constexpr double kBreakOut_m_s = 0.3;
constexpr double kLight = 0.9;  // of the capacity
constexpr double kDeeper_m_s = 0.2;
constexpr double kInAgain_m_s = 0.5;
constexpr double kEases_m_s = 0.5;
constexpr double kHeld = 0.9;          // overload that the crowd is held at
constexpr double kGain_m_s = 2.5;      // m/s by overload
constexpr double kSteeper = 0.8;       // of the speed at which the crowd retracts
constexpr double kHoistSpare = 0.9;    // overload of the hoist
constexpr double kLevel_m_s = 0.02;    // of the hoist: still level
constexpr double kDrawsIn_m_s = 0.1;   // of the motion: the dig rises
constexpr double kMeets = 0.05;        // of the crowd's stall force
constexpr double kSteepest = -0.7071;  // sine of the handle's angle
constexpr double kRoom_m = 0.1;        // to the crowd's stop
constexpr double kBehind_m = 0.1;

/// Out with a crowd that has force to spare: to the planned path, and beyond it where that is not
/// into the ground.
void go_in(const DigFeel& f, double spare_m_s, DigWish& wish) {
  if (f.behind_m > kBehind_m) {
    wish.crowd_back = -std::min(spare_m_s, kInAgain_m_s);
    wish.rate = kWaits;
  } else if (f.handle_rise > kSteepest && f.room_m > kRoom_m) {
    wish.crowd_back = -std::min(spare_m_s, kDeeper_m_s);
  }
}

}  // namespace

bool is_landed(bool before, const DigFeel& f) {
  if (!f.at_face || f.pays_out < -kDrawsIn_m_s) return false;
  return before || (f.carried < kCarried && f.pays_out >= kLevel_m_s);
}

DigWish dig_wish(const DigFeel& f, const DigLimits& limits) {
  DigWish wish;
  if (!f.at_face) return wish;
  const bool raises = f.pays_out < kLevel_m_s;
  if (f.carried < kCarried) {
    wish.crowd_back = kFree_m_s;
    wish.lift = kFree_m_s + std::max(0.0, f.pays_out);
    if (raises) wish.rate = kWaits;
    return wish;
  }
  if (f.landed) {
    wish.lift = std::max(0.0, f.pays_out);
    return wish;
  }
  if (!raises) return wish;
  const bool meets = f.resistance_N > kMeets * limits.crowd_stall_N;
  const double back = std::min(kGain_m_s * (f.overload - kHeld), kEases_m_s);
  if (f.load_kg >= limits.full_kg) {
    wish.crowd_back = meets ? std::max(back, kBreakOut_m_s) : 0.0;
  } else if (back > 0 && meets) {
    wish.crowd_back = back;
    if (f.hoist_overload < kHoistSpare) wish.lift = kSteeper * back;
  } else if (f.load_kg < kLight * limits.full_kg && (meets || f.behind_m > kBehind_m)) {
    go_in(f, -back, wish);
  }
  return wish;
}

}  // namespace dipper::mbs
