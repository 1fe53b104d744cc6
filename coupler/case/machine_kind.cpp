#include "coupler/case/machine_kind.hpp"

#include <fmt/format.h>

#include "common/begins_with.hpp"
#include "common/seconds.hpp"
#include "coupler/case/schema.hpp"
#include "machine/motion.hpp"
#include "machine/pose_table.hpp"

namespace dipper::cases {
namespace {

/// Keys that make sense only with a shovel's motion: swing to a truck, open door, return.
bool is_shovels(const std::string& key) {
  return (begins_with(key, "machine.") && key != "machine.kind" && key != "machine.poses") ||
         begins_with(key, "operator.") || begins_with(key, "collapse.") ||
         key == "pile.clean_floor_to_x_m";
}

}  // namespace

bool is_of_other_kind(const Case& c, const std::string& key) {
  if (c.machine.kind == MachineKind::shovel) return key == "machine.poses";
  return is_shovels(key) || (!has_truck(c) && (key == "truck" || begins_with(key, "truck.")));
}

void check_machine_kind(const Case& c, std::vector<Finding>& findings) {
  const bool poses = c.machine.kind == MachineKind::poses;
  for (const KeySpec& spec : schema()) {
    const bool others = poses ? is_shovels(spec.key) : spec.key == "machine.poses";
    if (others && c.origins.count(spec.key) != 0)
      findings.push_back(finding_at(
          c, spec.key,
          fmt::format("is not used by machine.kind {}; leave it out", poses ? "poses" : "shovel")));
  }
  if (poses && c.machine.poses.empty())
    findings.push_back(finding_at(c, "machine.kind",
                                  "poses needs machine.poses: a table with "
                                  "time_s,body,x_m,y_m,z_m,qw,qx,qy,qz"));
}

double motion_end_s(const Case& c) {
  return seconds(c.machine.kind == MachineKind::poses
                     ? machine::PoseTable::load(c.machine.poses).end_ns()
                     : machine::Motion::load(c.machine.motion).end_ns());
}

}  // namespace dipper::cases
