// When an operator digs once more before he turns to the truck.
#pragma once

namespace dipper::mbs {

/// What he goes by.
struct BiteSight {
  double path_s = 0;         ///< of the motion: where he is
  bool at_face = false;      ///< the house stands and the door is shut
  bool meets = false;        ///< the teeth meet rock
  bool caught = false;       ///< the dipper stands on rock (mbs/dig_rules.hpp)
  bool weighs_true = false;  ///< what he weighs has settled
  double handle_rise = 0;    ///< sine of the handle's angle over the horizontal
  double overload = 0;       ///< of the crowd
  double relief_m = 0;       ///< of the crowd, from the motion; below 0: further out
  double load_kg = 0;
  double full_kg = 0;  ///< what the dipper takes
};

/// Bites of one dig. The first is the motion's. When the teeth have come out of the face and the
/// dipper is less than 0.95 full, he takes another, up to three in all, as long as the last one has
/// brought a twentieth of what the dipper takes: goes back on his way with the crowd drawn in, to
/// where the teeth first met rock with the handle at most 45 degrees below the horizontal, crowds
/// until the face holds him, and lifts again along the way, up to 0.6 m deeper with each bite.
struct Bites {
  enum Phase { digs = 0, goes_back = 1, goes_in = 2 };

  Phase phase = digs;
  int begun = 0;        ///< of this dig; 0: the teeth have not met the face
  double from_s = 0;    ///< of the motion, where further ones begin
  double brought = 0;   ///< kg that he weighed after the last
  static constexpr double kDeeper_m = 0.6;  ///< that each may go beyond the one before

  /// What follows, with what he sees now.
  Bites next(const BiteSight& sees) const;
  /// How far out beyond the motion, m.
  double deepest_m() const { return kDeeper_m * (begun > 1 ? begun : 1); }
};

}  // namespace dipper::mbs
