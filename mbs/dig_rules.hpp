// The rules of an operator during a dig.
#pragma once

#include <optional>

namespace dipper::mbs {

/// The dig as positions and forces of hoist and crowd show it.
struct DigFeel {
  bool at_face = false;  ///< the house stands and the door is shut
  double pays_out = 0;   ///< rope by the motion, m/s: it lowers the dipper
  bool landed = false;   ///< is_landed
  double carried = 1;    ///< moment that the ropes hold, over that of the empty dipper
  double load_kg = 0;    ///< machine/handle_statics.hpp
  double resistance_N = 0;
  double handle_rise = 0;  ///< sine of the handle's angle over the horizontal
  double overload = 0;     ///< of the crowd
  double hoist_overload = 0;
  double behind_m = 0;  ///< of the crowd: how far the planned path is further out
  double room_m = 0;    ///< of the crowd to its outer stop
};

/// The change to the planned motion.
struct DigWish {
  double rate = 1;                   ///< along the motion, at most
  std::optional<double> crowd_back;  ///< m/s, below 0: out; none: as planned
  std::optional<double> lift;        ///< m/s of rope drawn in; none: as planned
};

/// The machine's numbers in the rules.
struct DigLimits {
  double full_kg = 0;        ///< capacity of the dipper
  double crowd_stall_N = 0;  ///< of the crowd's motor
};

/// Whether the dipper has come down on rock, caught, and the motion does not draw in rope by 0.1
/// m/s since. \param before  whether it had at the last look
bool is_landed(bool before, const DigFeel& feel);

/// The first rule that applies:
///   caught: the ropes hold less than half of the empty dipper's moment, so heel or lip rests on
///     rock. The crowd retracts by 0.3 m/s. While the motion raises the dipper, rope is drawn in by
///     0.3 m/s, at a quarter of the rate. While it lowers the dipper, which has come down on rock,
///     rope is drawn in by 0.3 m/s more than the motion pays out: the dig begins from there.
///   landed: the rope that was drawn in stays in, so that the dipper hangs while the crowd moves it
///     to the face.
///   full: the load is the dipper's capacity. The crowd retracts by 0.3 m/s while the teeth meet
///     rock, and stays there.
///   stalling: the crowd's overload is above 0.9 in rock. The crowd retracts by 2.5 m/s times the
///     difference, by at most 0.5 m/s, and where the hoist has force to spare, rope is drawn in by
///     0.8 of that speed: the teeth rise through the rock that the crowd cannot push into.
///   light: less than nine tenths of the capacity. Where the crowd is behind the planned path, it
///     goes out by at most 0.5 m/s at a quarter of the rate until it is there. In rock it goes
///     beyond the path by at most 0.2 m/s, with the handle at most 45 degrees below the horizontal:
///     below that it would push the dipper into the ground. Both with 2.5 m/s times the difference
///     of the overload from 0.9.
/// The teeth meet rock where the resistance is above a twentieth of the crowd's stall force.
DigWish dig_wish(const DigFeel& feel, const DigLimits& limits);

}  // namespace dipper::mbs
