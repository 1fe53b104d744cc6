#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "common/angles.hpp"
#include "common/gravity.hpp"
#include "coupler/check/warning_parts.hpp"

namespace dipper::check {
namespace {

constexpr double kOtherPower = 100;  ///< a speed of power / stall so far from the limit's
constexpr double kOtherLoad = 10;    ///< a rated load so far from the dipper full of rock
constexpr double kLeastRake_deg = 2;
constexpr double kMostStretch_m = 0.5;  ///< of ropes that hold the empty dipper

void warn_of_angles(const cases::Case& c, std::vector<Finding>& warnings) {
  if (c.machine.rake_angle_deg == 0)
    warnings.push_back(
        cases::finding_at(c, "machine.rake_angle_deg",
                          "0 degrees put the dipper in line with its handle; some 60 are usual"));
  else if (const double rake = std::abs(c.machine.rake_angle_deg); rake < kLeastRake_deg)
    warnings.push_back(cases::finding_at(
        c, "machine.rake_angle_deg",
        fmt::format(
            "{:g} degrees put the dipper almost in line with its handle: is the value in rad? "
            "write {:.1f}",
            c.machine.rake_angle_deg, degrees(c.machine.rake_angle_deg))));
  const double heading = std::abs(c.truck.heading_deg);
  if (heading > 0 && heading < 2 * M_PI && heading != std::floor(heading))
    warnings.push_back(
        cases::finding_at(c, "truck.heading_deg",
                          fmt::format("{:g} degrees: is the value in rad? write {:.0f}",
                                      c.truck.heading_deg, degrees(c.truck.heading_deg))));
}

void warn_of_drives(const CaseParts& parts, std::vector<Finding>& warnings) {
  const machine::MachineData& m = parts.machine;
  const auto say = [&](const std::string& key, const std::string& what) {
    warnings.push_back({parts.c.machine.model, 0, key, what});
  };
  const double empty_N = (m.dipper.mass + m.door.mass) * kGravity_m_s2;
  if (m.drives.hoist.stall < empty_N)
    say("drives.hoist_stall",
        fmt::format("{:.3g} N do not lift the empty dipper, {:.3g} N: in kN, perhaps?",
                    m.drives.hoist.stall, empty_N));
  struct Drive {
    std::string name;
    machine::MachineData::DriveLimit limit;
    double speed;
  };
  for (const Drive& d : {Drive{"hoist", m.drives.hoist, m.limits.hoist_speed},
                         Drive{"crowd", m.drives.crowd, m.limits.crowd_speed},
                         Drive{"swing", m.drives.swing, m.limits.swing_speed}}) {
    const double of_limit = d.limit.power / d.limit.stall / d.speed;
    if (of_limit < 1 / kOtherPower || of_limit > kOtherPower)
      say("drives." + d.name + "_power",
          fmt::format(
              "{:g} and a stall of {:g} give full force up to {:.2g} times the speed limit: "
              "is one of the three in another unit?",
              d.limit.power, d.limit.stall, of_limit));
  }
  if (parts.c.machine.crowd_friction_N > m.drives.crowd.stall)
    warnings.push_back(cases::finding_at(
        parts.c, "machine.crowd_friction_N",
        fmt::format("{:.3g} N are more than the crowd's stall force, {:.3g} N: it cannot move",
                    parts.c.machine.crowd_friction_N, m.drives.crowd.stall)));
  const double full_kg = m.dipper.struck_volume * parts.c.rock.bulk_density_kg_m3;
  const double rated = m.dipper.rated_load;
  if (rated > 0 && (rated > kOtherLoad * full_kg || rated < full_kg / kOtherLoad))
    say("dipper.rated_load",
        fmt::format("{:g} kg, but the dipper full of this rock holds {:.2g} kg: in t, perhaps?",
                    rated, full_kg));
}

void warn_of_handle(const CaseParts& parts, std::vector<Finding>& warnings) {
  const machine::MachineData& m = parts.machine;
  const double center_m = m.handle.mass_center;
  // All out, the handle still reaches back to the saddle.
  const double length_m = m.handle.reach_at_zero_crowd + m.limits.crowd_max;
  if (center_m > 0 || center_m < -length_m)
    warnings.push_back(
        {parts.c.machine.model, 0, "handle.mass_center",
         fmt::format("{:g} m is {} the handle, some {:.3g} m long: it is negative, from the dipper "
                     "end towards the saddle",
                     center_m, center_m > 0 ? "in front of" : "behind", length_m)});
}

void warn_of_ropes(const CaseParts& parts, std::vector<Finding>& warnings) {
  const machine::MachineData& m = parts.machine;
  const double pull_N = 0.5 * (m.dipper.mass + m.door.mass) * kGravity_m_s2;  // on one rope
  const double free_m =
      std::max(0.0, m.rope.length_at_zero_hoist - (m.boom.point - m.rope.drum).norm());
  const double stretch_m = pull_N * m.rope.elastic_fraction * free_m / m.rope.axial_stiffness;
  const double soft = parts.c.machine.rope_compliance;
  if (soft > 1 && soft * stretch_m > kMostStretch_m)
    warnings.push_back(
        cases::finding_at(parts.c, "machine.rope_compliance",
                          fmt::format("with {:g} times the stretch the ropes give {:.2g} m under "
                                      "the empty dipper",
                                      soft, soft * stretch_m)));
  if (stretch_m > kMostStretch_m)
    warnings.push_back(
        {parts.c.machine.model, 0, "rope.axial_stiffness",
         fmt::format("{:.3g} N let the ropes stretch by {:.2g} m under the empty dipper: in kN, "
                     "perhaps? it is EA of one rope",
                     m.rope.axial_stiffness, stretch_m)});
}

}  // namespace

void warn_of_machine(const CaseParts& parts, std::vector<Finding>& warnings) {
  warn_of_angles(parts.c, warnings);
  warn_of_drives(parts, warnings);
  warn_of_handle(parts, warnings);
  warn_of_ropes(parts, warnings);
}

}  // namespace dipper::check
