#include "mbs/more_bites.hpp"

namespace dipper::mbs {
namespace {

constexpr int kMost = 3;
constexpr double kFilled = 0.95;          // of what the dipper takes
constexpr double kPays = 0.05;          // of that
constexpr double kBelow = -0.7071;   // sine of the handle's angle: 45 degrees down
constexpr double kShortest_s = 3;       // of the motion: a bite
constexpr double kHeldAt = 0.9;          // overload of a crowd that the face holds

}  // namespace

Bites Bites::next(const BiteSight& s) const {
  if (!s.at_face) return {};
  Bites b = *this;
  switch (phase) {
    case digs:
      if (begun == 0 && s.meets && s.handle_rise > kBelow) {
        b.begun = 1;
        b.from_s = s.path_s;
      }
      if (begun > 0 && begun < kMost && !s.meets && s.weighs_true &&
          s.path_s > from_s + kShortest_s && s.load_kg < kFilled * s.full_kg &&
          (begun == 1 || s.load_kg - brought > kPays * s.full_kg)) {
        b.phase = goes_back;
        b.brought = s.load_kg;
      }
      break;
    case goes_back:
      if (s.path_s <= from_s || s.caught) {
        b.phase = goes_in;
        ++b.begun;
      }
      break;
    case goes_in:
      if (s.overload > kHeldAt || s.relief_m < -deepest_m()) b.phase = digs;
      break;
  }
  return b;
}

}  // namespace dipper::mbs
