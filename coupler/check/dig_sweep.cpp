#include "coupler/check/dig_sweep.hpp"

#include <fmt/format.h>

#include "common/angles.hpp"
#include "coupler/deck/pile_shape.hpp"
#include "machine/swept_face.hpp"

namespace dipper::check {

// Of the dipper's struck volume: rock also comes in from the sides.
constexpr double kLeanPass = 0.5;

std::vector<DigSweep> dig_sweeps(const CaseParts& parts) {
  const machine::MachineData& machine = parts.machine;
  const machine::ShovelKinematics shovel(machine, Pose{}, radians(parts.c.machine.rake_angle_deg));
  const auto face = [&](double heading_rad) {
    return deck::bench_along_boom(parts.c, heading_rad);
  };
  std::vector<DigSweep> sweeps;
  for (const machine::SweptPass& pass : swept_passes(parts.motion, shovel, face)) {
    const double volume_m3 = pass.area_m2 * machine.dipper.inside.y();
    sweeps.push_back({volume_m3, pass.deepest_m, pass.first,
                      pass.first && volume_m3 < kLeanPass * machine.dipper.struck_volume});
  }
  return sweeps;
}

void warn_of_sweep(const CaseParts& parts, std::vector<Finding>& warnings) {
  if (!parts.dug.none.empty())
    warnings.push_back(cases::finding_at(parts.c, "machine.plan",
                                         "on the bench as the case makes it the operator finds no "
                                         "dig, so the run may end without a pass: " +
                                             parts.dug.none));
  int number = 0;
  for (const DigSweep& sweep : dig_sweeps(parts)) {
    ++number;
    if (sweep.lean)
      warnings.push_back(cases::finding_at(
          parts.c, parts.planned() ? "machine.plan" : "machine.motion",
          fmt::format("pass {} cannot fill the dipper; plan it deeper or further out "
                      "(docs/motion.md)",
                      number)));
  }
}

}  // namespace dipper::check
