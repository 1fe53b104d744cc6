// A row of motion.csv: where the teeth are at a time, said in drives.
#pragma once

#include <string>

#include "machine/kinematics.hpp"

namespace dipper::machine {

inline constexpr char kMotionHead[] = "time_s,hoist_m,crowd_m,swing_deg,door_deg\n";

/// The row with its end of line. `tip` is in the plane of the boom, as
/// ShovelKinematics::teeth_at has it. Throws std::domain_error, with time and point, where the
/// machine cannot put its teeth.
std::string motion_row(double t_s, const Eigen::Vector2d& tip, double swing_rad, double door_rad,
                       const ShovelKinematics& shovel);

}  // namespace dipper::machine
