// A joint whose coordinate is where one of the drives is sent, so that the drive's force comes out
// as a reaction.
#pragma once

#include <Simbody.h>

#include <functional>

#include "machine/motion.hpp"

namespace dipper::mbs {

/// Where the drives are sent at a time [s].
using Sent = std::function<machine::DriveState(double t_s)>;

/// Prescribes the one coordinate of `joint` as scale * sent(t), at position level.
///
/// \param which the drive, e.g. &Drives::crowd
/// \param scale from the drive's unit to the joint's, e.g. 1/R for a sheave a rope turns
void prescribe(SimTK::MobilizedBody& joint, Sent sent, double machine::Drives::*which,
               double scale = 1);

/// What the drives put into the joints they prescribe, one entry a mobility (0 for free ones):
/// force [N] or torque [N m], positive along the coordinate. Stage: Acceleration.
SimTK::Vector drive_forces(const SimTK::SimbodyMatterSubsystem& matter, const SimTK::State& state);

}  // namespace dipper::mbs
