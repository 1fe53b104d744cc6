// A path of the teeth with speeds: from points in a CSV to the drives' curves.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "machine/kinematics.hpp"
#include "machine/teeth_path.hpp"

namespace dipper::machine {

/// Position of teeth, house and door at a time.
struct PathPoint {
  double t_s = 0;
  Vector2d tip = Vector2d::Zero();  ///< in the plane of the boom, m
  double speed_m_s = 0;             ///< of the teeth in that plane
  double swing_rad = 0, door_rad = 0;
};

struct TimedPath {
  std::vector<PathPoint> points;
  /// The path to points[i + 1]; a single point during a stop.
  std::vector<TeethPath> legs;
};

/// Reads a table of x_m,z_m,speed_m_s,wait_s,swing_deg,door_deg. The teeth go through the points on
/// a smooth curve, which may have a corner at a stop, and from one speed to the next at
/// constant acceleration. A row that repeats the point of the one before is a stop of wait_s.
/// Throws InputError with every fault and its line.
TimedPath read_timed_path(const std::filesystem::path& file);

/// The rows of motion.csv, without its head. House and door move between the points as between the
/// rows of a motion. Throws std::domain_error as motion_row does.
std::string motion_rows(const TimedPath& path, const ShovelKinematics& shovel);

}  // namespace dipper::machine
