#include "mbs/drive_friction.hpp"

#include <cmath>

namespace dipper::mbs {

double DriveFriction::crowd(double speed) const {
  if (losses.crowd_friction == 0) return 0;
  return -losses.crowd_friction * std::tanh(speed / kStandstill);
}

double DriveFriction::hoist(double tension, double speed) const {
  if (losses.hoist_loss == 0) return 0;
  return -losses.hoist_loss * tension * std::tanh(speed / kStandstill);
}

}  // namespace dipper::mbs
