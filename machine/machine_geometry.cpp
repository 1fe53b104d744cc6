#include "machine/machine_geometry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/angles.hpp"
#include "machine/kinematics.hpp"

namespace dipper::machine {
namespace {

constexpr int kCrowds = 12, kAngles = 60;  // a grid over the range within the limits
// Of rope, beyond the dead centre: limits may meet it in their corner (crowd in, handle up).
constexpr double kDeadCentre_m = 0.05;

struct Extent {
  const char* key;
  double low, high;
};

/// Limits with nothing between them.
void find_empty_limits(const MachineData::Limits& l, std::vector<std::string>& faults) {
  for (const Extent& e :
       {Extent{"hoist", l.hoist_min, l.hoist_max}, Extent{"crowd", l.crowd_min, l.crowd_max},
        Extent{"door", l.door_min, l.door_max}, Extent{"saddle", l.saddle_min, l.saddle_max}})
    if (!(e.low < e.high))
      faults.push_back(
          fmt::format("limits.{0}_min is {1:.4g}, not below limits.{0}_max, {2:.4g} (m, rad)",
                      e.key, e.low, e.high));
}

/// Of a body: no moment of inertia exceeds the sum of the two others.
void find_impossible_inertias(const MachineData& m, std::vector<std::string>& faults) {
  for (const auto& [body, inertia] : {std::pair{"handle", m.handle.inertia},
                                      {"dipper", m.dipper.inertia},
                                      {"door", m.door.inertia}})
    if (inertia.minCoeff() < 0 || 2 * inertia.maxCoeff() > inertia.sum() * (1 + 1e-9))
      faults.push_back(fmt::format(
          "{}.inertia is [{:.4g}, {:.4g}, {:.4g}] kg m2, which no body has: the largest may be the "
          "sum of the two others",
          body, inertia.x(), inertia.y(), inertia.z()));
}

/// Reports a bail inside the sheave, and a rope that pulls the handle down.
std::string fault_at(const MachineData& m, const ShovelKinematics& shovel, double crowd) {
  const MachineData::Limits& l = m.limits;
  const auto angle = [&](int k) {
    return l.saddle_min + (l.saddle_max - l.saddle_min) * k / kAngles;
  };
  const auto with = [&](double saddle) {
    return fmt::format("with the handle at {:.0f} deg and the crowd at {:.2f} m", degrees(saddle),
                       crowd);
  };
  double shortest = std::numeric_limits<double>::infinity();
  for (int k = 0; k <= kAngles; ++k) {
    const Vector3d p = shovel.pose({0, crowd, 0, 0}, angle(k)).X_WB * m.dipper.bail;
    const double off = std::hypot(p.x() - m.boom.point.x(), p.z() - m.boom.point.z());
    if (off <= m.boom.sheave_radius)
      return fmt::format(
          "{} the bail is {:.2f} m from the sheave's axis, within its radius of {:.2f} m",
          with(angle(k)), off, m.boom.sheave_radius);
    const double path = shovel.rope_path(angle(k), crowd);
    if (path > shortest + kDeadCentre_m)
      return fmt::format("{} hoisting lowers the dipper: the bail is above the boom's point",
                         with(angle(k)));
    shortest = std::min(shortest, path);
  }
  const double at_zero = m.rope.length_at_zero_hoist;
  const double low = shovel.rope_path(l.saddle_max, crowd) - at_zero,
               high = shovel.rope_path(l.saddle_min, crowd) - at_zero;
  if (low > l.hoist_max || high < l.hoist_min)
    return fmt::format(
        "at a crowd of {:.2f} m the ropes hold the bail with a hoist from {:.2f} to {:.2f} m, and "
        "limits.hoist_min and hoist_max are {:.2f} and {:.2f} m: rope.length_at_zero_hoist, {:.2f} "
        "m, is too {} or another dimension is wrong",
        crowd, low, high, l.hoist_min, l.hoist_max, at_zero, low > l.hoist_max ? "short" : "long");
  return {};
}

}  // namespace

std::vector<std::string> geometry_faults(const MachineData& m, double rake) {
  std::vector<std::string> faults;
  find_empty_limits(m.limits, faults);
  find_impossible_inertias(m, faults);
  const double drum =
      std::hypot(m.rope.drum.x() - m.boom.point.x(), m.rope.drum.z() - m.boom.point.z());
  if (drum <= m.boom.sheave_radius)
    faults.push_back(fmt::format(
        "rope.drum is {:.2f} m from the sheave's axis, within boom.sheave_radius, {:.2f} m", drum,
        m.boom.sheave_radius));
  if (!faults.empty()) return faults;
  const ShovelKinematics shovel(m, Pose{}, rake);
  for (int k = 0; k <= kCrowds; ++k) {
    const double crowd =
        m.limits.crowd_min + (m.limits.crowd_max - m.limits.crowd_min) * k / kCrowds;
    if (std::string fault = fault_at(m, shovel, crowd); !fault.empty()) return {fault};
  }
  return {};
}

}  // namespace dipper::machine
