// A pass that has been decided on, as rows of motion.csv.
#pragma once

#include <string>

#include "machine/kinematics.hpp"
#include "machine/motion_plan.hpp"

namespace dipper::machine {

/// Where a pass begins.
struct PassStart {
  double t_s = 0;        ///< of the motion
  bool at_dump = false;  ///< over the truck with the door open; else in front of the face
  Vector2d tip = Vector2d::Zero();  ///< of the teeth, in the plane of the boom; not at the dump
  double heading_rad = 0;
};

struct PassTimes {
  double dig_s = 0;   ///< the teeth set off into the face
  double dump_s = 0;  ///< the door begins to open
  double end_s = 0;   ///< the dipper is empty: the last row
};

/// When the parts of a pass are done: a cycle of the plan, with the dig at a speed of the teeth,
/// and turns of the house at the plan's speed. The house begins to turn when the dipper is over
/// what is in its way. \param over_m  height of the rock beside the dig
PassTimes pass_times(const MotionPlan& cycle, const PlannedPass& pass, double teeth_m_s,
                     double over_m, const PassStart& from, const ShovelKinematics& shovel);

/// Rows from the start on, first back to the face where it is at the dump, until the dipper is
/// empty over the truck. Throws as motion_row.
std::string pass_rows(const MotionPlan& cycle, const PlannedPass& pass, double teeth_m_s,
                      double over_m, const PassStart& from, const ShovelKinematics& shovel);

}  // namespace dipper::machine
