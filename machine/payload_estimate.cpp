#include "machine/payload_estimate.hpp"

#include <cmath>

#include "common/gravity.hpp"

namespace dipper::machine {
namespace {

constexpr double kTurn = 1e-5;  // rad, of the handle: for the rope's lever

}  // namespace

PayloadEstimate::PayloadEstimate(const MachineData& machine, double rake)
    : machine_(machine), shovel_(machine, Pose{}, rake) {}

double PayloadEstimate::load_kg(const Drives& at, double hoist_force) const {
  const double saddle = shovel_.saddle_angle(at.hoist, at.crowd);
  // By virtual work: the rope's lever is what its path loses as the handle rises.
  const double lever =
      (shovel_.rope_path(saddle - kTurn, at.crowd) - shovel_.rope_path(saddle + kTurn, at.crowd)) /
      (2 * kTurn);
  Drives ahead = at;
  ahead.swing = 0;
  const ShovelPose pose = shovel_.pose(ahead, saddle);
  const auto out = [&](const Vector3d& p_W) { return p_W.x() - machine_.saddle.position.x(); };
  const double handle_end =
      (machine_.handle.reach_at_zero_crowd + at.crowd + machine_.handle.mass_center) *
      std::cos(saddle);
  const double empty = machine_.handle.mass * handle_end +
                       machine_.dipper.mass * out(pose.X_WB * machine_.dipper.mass_center) +
                       machine_.door.mass * out(pose.X_WD * machine_.door.mass_center);
  const Vector3d load_B(machine_.dipper.inside.x() / 2, 0, 0);
  return (hoist_force * lever / kGravity_m_s2 - empty) / out(pose.X_WB * load_B);
}

}  // namespace dipper::machine
