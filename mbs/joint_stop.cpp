#include "mbs/joint_stop.hpp"

#include <algorithm>

namespace dipper::mbs {

double JointStop::depth(double x) const { return x - std::clamp(x, low, high); }

double JointStop::force(double x, double v) const {
  const double d = depth(x), wanted = -stiffness * d - damping * v;
  if (d > 0) return std::min(0.0, wanted);
  if (d < 0) return std::max(0.0, wanted);
  return 0;
}

double JointStop::energy(double x) const { return 0.5 * stiffness * depth(x) * depth(x); }

double JointStop::dissipation(double x, double v) const {
  return -(force(x, v) + stiffness * depth(x)) * v;
}

}  // namespace dipper::mbs
