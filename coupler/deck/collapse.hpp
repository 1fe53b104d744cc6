// Rock over the bench that comes down during a dig: place, amount and time.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "coupler/case/case.hpp"
#include "machine/motion.hpp"

namespace dipper::deck {

/// The slab of collapse.height_m, measured straight up, over the upper half of the bench's face and
/// its crest. A scanned face is taken as straight from half its height to its crest, and the slab
/// is lifted over parts in front of that. Until it comes loose the bank behind the bench carries
/// it, and it is not simulated. Then it appears over the bench as loose as poured rock, and so
/// thicker. In W; along y as wide as the bench.
struct CollapseSlab {
  double face_x_m = 0, foot_z_m = 0;  ///< the middle of the face, where it begins
  double foot_x_m = 0;                ///< x of its sloping upper side, continued to that height
  double crest_x_m = 0, crest_z_m = 0;
  double rear_x_m = 0;
  double top_m = 0;
  double run_m = 0;  ///< along x, of the face's slope from the foot's height to the top's
  double mass_kg = 0;
};

/// Of a case whose collapse.height_m is above 0.
CollapseSlab collapse_slab(const cases::Case& c);

/// The time when it comes loose: collapse.at_s, or when the motion first opens the door, with the
/// first load over the truck. Empty when that never happens.
std::optional<double> collapse_time_s(const cases::Case& c, const machine::Motion& motion);

/// The variables of dem_in/collapse.in, name and value.
std::vector<std::pair<std::string, std::string>> collapse_variables(const CollapseSlab& s);

}  // namespace dipper::deck
