// A row of motion.csv from the position of the teeth at a time.
#pragma once

#include <string>

#include "machine/kinematics.hpp"

namespace dipper::machine {

inline constexpr char kMotionHead[] = "time_s,hoist_m,crowd_m,swing_deg,door_deg\n";

/// The row with its end of line. `tip` is in the plane of the boom, as
/// in ShovelKinematics::teeth_at. Throws std::domain_error, with time and point, for a point that
/// the machine's teeth cannot reach.
std::string motion_row(double t_s, const Eigen::Vector2d& tip, double swing_rad, double door_rad,
                       const ShovelKinematics& shovel);

}  // namespace dipper::machine
