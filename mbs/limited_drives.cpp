#include "mbs/limited_drives.hpp"

#include <algorithm>
#include <cmath>

namespace dipper::mbs {
namespace {

// How far a drive at its limit is behind: below what the teeth's way is known to, and so stiff that
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

LimitedDrives::LimitedDrives(const machine::MachineData& m, Sent sent, SimTK::MobilizedBody drum,
                             SimTK::MobilizedBody handle, SimTK::MobilizedBody house)
    : sent_(std::move(sent)),
      radius_(m.boom.sheave_radius),
      drum_(std::move(drum)),
      handle_(std::move(handle)),
      house_(std::move(house)),
      hoist_(m.drives.hoist, kLag_m, m.drives.hoist_inertia),
      crowd_(m.drives.crowd, kLag_m, on_slide(m)),
      swing_(m.drives.swing, kLag_m / swing_reach(m),
             m.house.swing_inertia + on_slide(m) * swing_reach(m) * swing_reach(m)) {}

void LimitedDrives::set_trims(const machine::Drives& force) {
  hoist_.set_trim(force.hoist);
  crowd_.set_trim(force.crowd);
  swing_.set_trim(force.swing);
}

machine::DriveState LimitedDrives::where(const SimTK::State& s) const {
  machine::DriveState w{};
  w.position = {radius_ * drum_.getOneQ(s, 0), handle_.getOneQ(s, 0), house_.getOneQ(s, 0), 0};
  w.rate = {radius_ * drum_.getOneU(s, 0), handle_.getOneU(s, 0), house_.getOneU(s, 0), 0};
  return w;
}

DriveEffort LimitedDrives::effort(const LimitedDrive& drive, double machine::Drives::*which,
                                  const SimTK::State& state) const {
  const machine::DriveState to = sent_(state.getTime());
  const machine::DriveState is = where(state);
  const double speed = is.rate.*which;
  const double wanted =
      drive.wanted(to.position.*which - is.position.*which, to.rate.*which - speed);
  return {wanted, drive.most(speed), drive.force(wanted, speed), speed, to.rate.*which};
}

DriveEffort LimitedDrives::hoist(const SimTK::State& s) const {
  return effort(hoist_, &machine::Drives::hoist, s);
}
DriveEffort LimitedDrives::crowd(const SimTK::State& s) const {
  return effort(crowd_, &machine::Drives::crowd, s);
}
DriveEffort LimitedDrives::swing(const SimTK::State& s) const {
  return effort(swing_, &machine::Drives::swing, s);
}

Overload LimitedDrives::overload(const SimTK::State& s) const {
  const auto of = [](const DriveEffort& e) {
    return e.wanted * e.sent_speed >= 0 ? std::abs(e.wanted) / e.most : 0.0;
  };
  return {of(crowd(s)), std::max(of(hoist(s)), of(swing(s)))};
}

void LimitedDrives::calcForce(const SimTK::State& s, SimTK::Vector_<SimTK::SpatialVec>&,
                              SimTK::Vector_<SimTK::Vec3>&, SimTK::Vector& mobility_forces) const {
  drum_.applyOneMobilityForce(s, 0, radius_ * hoist(s).force, mobility_forces);
  handle_.applyOneMobilityForce(s, 0, crowd(s).force, mobility_forces);
  house_.applyOneMobilityForce(s, 0, swing(s).force, mobility_forces);
}

}  // namespace dipper::mbs
