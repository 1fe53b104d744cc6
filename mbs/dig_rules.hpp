// What an operator does in a dig by what he feels.
#pragma once

#include <optional>

namespace dipper::mbs {

/// What he feels of the dig, by his own instruments.
struct DigFeel {
  bool at_face = false;  ///< the house stands and the door is shut
  bool raises = false;   ///< the motion does not let the dipper down
  double carried = 1;    ///< moment that the ropes hold, over that of the empty dipper
  double load_kg = 0;    ///< machine/handle_statics.hpp
  double resistance_N = 0;
  double handle_rise = 0;  ///< sine of the handle's angle over the horizontal
  double overload = 0;     ///< of the crowd
  double room_m = 0;       ///< of the crowd to its outer stop
};

/// What he asks of the machine.
struct DigWish {
  double rate = 1;                   ///< along the motion, at most
  std::optional<double> crowd_back;  ///< m/s, below 0: further out; none: as the motion says
  std::optional<double> lift;        ///< m/s of rope drawn in; none: as the motion says
};

/// The machine's numbers in the rules.
struct DigLimits {
  double full_kg = 0;        ///< what the dipper takes
  double crowd_stall_N = 0;  ///< of the crowd's motor
};

/// The rules, the first that holds:
///   caught: the ropes hold less than half of the empty dipper, so heel or lip stands on rock. He
///     draws rope in and the crowd back, 0.3 m/s each, and waits on his way (a quarter of the
///     rate).
///   full: the load is what the dipper takes. He breaks out: the crowd comes back by 0.3 m/s while
///     the teeth meet rock, and stays there.
///   in rock: the crowd is held at its stall force, and the hoist goes on. It goes out or comes
///   back
///     at 2.5 m/s by the overload's difference from 1: out by at most 0.2 m/s, and
///     only with less than nine tenths of a load and the handle at most 45 degrees below the
///     horizontal (further down it would push the dipper into the ground); back by at most 0.5 m/s.
/// Teeth meet rock from a twentieth of the crowd's stall force on.
DigWish dig_wish(const DigFeel& feel, const DigLimits& limits);

}  // namespace dipper::mbs
