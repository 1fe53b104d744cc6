#include "mbs/limited_drives.hpp"

#include <algorithm>
#include <cmath>

namespace dipper::mbs {
namespace {

// The lag of a drive at its limit: below the accuracy of the path of the teeth, and so stiff that
// the ropes stay the softest part of the hoist.
constexpr double kLag_m = 0.05;

double on_slide(const machine::MachineData& m) {
  return m.handle.mass + m.dipper.mass + m.door.mass;
}

/// From the swing axis to the dipper with the handle level and the crowd at 0, m.
double swing_reach(const machine::MachineData& m) {
  return m.saddle.position.x() + m.handle.reach_at_zero_crowd;
}

}  // namespace

LimitedDrives::LimitedDrives(const machine::MachineData& m)
    : hoist_(m.drives.hoist, kLag_m, m.drives.hoist_inertia),
      crowd_(m.drives.crowd, kLag_m, on_slide(m)),
      swing_(m.drives.swing, kLag_m / swing_reach(m),
             m.house.swing_inertia + on_slide(m) * swing_reach(m) * swing_reach(m)) {}

void LimitedDrives::set_trims(const machine::Drives& force) {
  hoist_.set_trim(force.hoist);
  crowd_.set_trim(force.crowd);
  swing_.set_trim(force.swing);
}

DriveEfforts LimitedDrives::efforts(const machine::DriveState& to,
                                    const machine::DriveState& are) const {
  const auto effort = [&](const LimitedDrive& drive, double machine::Drives::*which) {
    const double speed = are.rate.*which;
    const double wanted =
        drive.wanted(to.position.*which - are.position.*which, to.rate.*which - speed);
    return DriveEffort{wanted, drive.most(speed), drive.force(wanted, speed), speed,
                       to.rate.*which};
  };
  return {effort(hoist_, &machine::Drives::hoist), effort(crowd_, &machine::Drives::crowd),
          effort(swing_, &machine::Drives::swing)};
}

double DriveEffort::overload() const {
  return wanted * sent_speed > 0 ? std::abs(wanted) / most : 0.0;
}

Overload DriveEfforts::overload() const {
  return {crowd.overload(), std::max(hoist.overload(), swing.overload())};
}

}  // namespace dipper::mbs
