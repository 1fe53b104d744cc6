#include "mbs/drive_limit.hpp"

#include <algorithm>
#include <cmath>

namespace dipper::mbs {

LimitedDrive::LimitedDrive(const machine::MachineData::DriveLimit& limit, double lag,
                           double moved_mass)
    : limit_(limit),
      stiffness_(limit.stall / lag),
      damping_(2 * std::sqrt(stiffness_ * moved_mass)) {}

double LimitedDrive::wanted(double behind, double slower) const {
  return trim_ + stiffness_ * behind + damping_ * slower;
}

double LimitedDrive::most(double speed) const {
  // Written so that a drive at rest does not divide by zero.
  return limit_.stall * std::abs(speed) > limit_.power ? limit_.power / std::abs(speed)
                                                       : limit_.stall;
}

double LimitedDrive::force(double wanted, double speed) const {
  return std::clamp(wanted, -most(speed), most(speed));
}

}  // namespace dipper::mbs
