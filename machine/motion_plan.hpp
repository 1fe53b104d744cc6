// The plan of a cycle of digs: from the path of the teeth to the drives' curves.
#pragma once

#include <string>
#include <vector>

#include "machine/kinematics.hpp"
#include "machine/teeth_path.hpp"

namespace dipper::machine {

/// A share of 0 ... 1 over a time, at constant speed except at its ends, where the speed's ramps
/// are half waves of a sine. Zero before it, one after it.
struct Move {
  double start_s = 0, end_s = 0, ramp_s = 0;
  double share(double t_s) const;
};

/// One pass: control polygon of the path of the teeth through the rock, and heading of the boom.
struct PlannedPass {
  TeethPath dig;
  double heading_rad = 0;
};

/// Times are from a cycle's start.
struct MotionPlan {
  double sample_s = 0;  ///< between rows
  double cycle_s = 0;
  Move dig;                    ///< the teeth, from the dig's start to the dump
  Move back;                   ///< the teeth, from the dump to the next dig
  Move swing_out, swing_back;  ///< the house
  Move door_open, door_close;
  TeethPath lift;       ///< control points between a dig and the dump, the dump's the last
  TeethPath lower;      ///< control points between the dump and the next dig
  double dump_rad = 0;  ///< heading of the boom over the truck
  double door_rad = 0;  ///< opening over the truck
  bool returns = true;  ///< false: the motion ends with the dump
  std::vector<PlannedPass> passes;
};

/// The rows of motion.csv, without its head: time_s,hoist_m,crowd_m,swing_deg,door_deg. After the
/// last pass the dipper returns to the first dig. Throws std::domain_error, with time and point,
/// that the machine's teeth cannot reach.
std::string motion_rows(const MotionPlan& plan, const ShovelKinematics& shovel);

}  // namespace dipper::machine
