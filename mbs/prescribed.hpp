// A joint whose coordinate follows one of the drives exactly, so that the drive's force comes out
// as a reaction.
#pragma once

#include <Simbody.h>

#include <memory>

#include "machine/motion.hpp"

namespace dipper::mbs {

/// Prescribes the one coordinate of `joint` as scale * drive(t), at position level.
///
/// \param which the drive, e.g. &Drives::crowd
/// \param scale from the drive's unit to the joint's, e.g. 1/R for a sheave a rope turns
void prescribe(SimTK::MobilizedBody& joint, std::shared_ptr<const machine::Motion> motion,
               double machine::Drives::*which, double scale = 1);

/// What the drives put into the joints they prescribe, one entry a mobility (0 for free ones):
/// force [N] or torque [N m], positive along the coordinate. Stage: Acceleration.
SimTK::Vector drive_forces(const SimTK::SimbodyMatterSubsystem& matter, const SimTK::State& state);

}  // namespace dipper::mbs
