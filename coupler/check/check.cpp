// check_case: checks that need several parts of a case.
#include "coupler/check/check.hpp"

#include <map>

#include "coupler/case/machine_kind.hpp"
#include "coupler/check/check_parts.hpp"

namespace dipper::check {

bool file_exists(const cases::Case& c, const std::string& key, const std::filesystem::path& file,
                 Findings& findings) {
  if (std::filesystem::is_regular_file(file)) return true;
  findings.push_back(cases::finding_at(c, key, "no such file: " + file.string()));
  return false;
}

std::vector<Finding> check_case(const cases::Case& c) {
  std::vector<Finding> findings;
  std::map<std::string, mesh::TriangleMesh> bodies;
  for (const auto& [name, file] : c.bodies) {
    const std::string key = "bodies." + name;
    auto body = load_sound_mesh(c, key, file, findings);
    if (body && check_unit(c, key, *body, findings)) bodies.emplace(name, std::move(*body));
  }
  if (const auto dipper = bodies.find("dipper"); dipper != bodies.end()) {
    check_tooth_wear(c, dipper->second, findings);
  }
  if (cases::has_truck(c)) {
    const std::size_t before = findings.size();
    if (const auto truck = load_sound_mesh(c, "truck.mesh", c.truck.mesh, findings);
        truck && check_unit(c, "truck.mesh", *truck, findings)) {
      check_truck_in_domain(c, *truck, findings);
      if (findings.size() == before) check_bed(c, *truck, findings);
    }
  }
  check_mesh_facts(c, findings);
  check_pile_in_domain(c, findings);
  if (c.machine.kind == cases::MachineKind::poses) {
    check_poses(c, bodies, findings);
  } else if (const auto motion = check_motion(c, bodies, findings)) {
    check_windows(c, motion->end_ns(), findings);
  }
  check_rock(c, findings);
  return findings;
}

}  // namespace dipper::check
