#include <set>

#include "common/input_error.hpp"
#include "coupler/check/check_parts.hpp"
#include "machine/pose_table.hpp"

namespace dipper::check {

namespace {

// Names that the scripts of dem_in use for something else.
const std::set<std::string> kTaken = {"box",          "gravity",    "ground", "pour",
                                      "rocks",        "rocks_move", "sides",  "slab",
                                      "spheres_move", "truck",      "walls"};

}  // namespace

void check_poses(const cases::Case& c, const std::map<std::string, mesh::TriangleMesh>& bodies,
                 Findings& findings) {
  if (!file_exists(c, "machine.poses", c.machine.poses, findings)) return;
  std::optional<machine::PoseTable> table;
  try {
    table = machine::PoseTable::load(c.machine.poses);
  } catch (const InputError& e) {
    return cases::add_file_findings(c, "machine.poses", e, findings);
  }
  for (const auto& body : c.bodies)
    if (!table->has(body.first))
      findings.push_back(cases::finding_at(c, "bodies." + body.first,
                                           "has no row in machine.poses; write one or more"));
  for (const std::string& name : table->bodies())
    if (c.bodies.count(name) == 0)
      findings.push_back({c.machine.poses, 0, "body",
                          name + " is not under bodies in the case; name its mesh there"});
  for (const auto& body : c.bodies)
    if (kTaken.count(body.first) != 0)
      findings.push_back(cases::finding_at(c, "bodies." + body.first,
                                           "the rock's scripts use this name; choose another"));
  std::map<std::string, mesh::TriangleMesh> known = bodies;
  for (const auto& body : bodies)
    if (!table->has(body.first)) known.erase(body.first);
  const auto pose = [&](const std::string& body, std::int64_t t_ns) {
    return std::optional(table->at(body, t_ns).X_WB);
  };
  check_bodies_in_domain(c, pose, 0, table->end_ns(), known, findings);
  check_windows(c, 0, table->end_ns(), findings);
}

}  // namespace dipper::check
