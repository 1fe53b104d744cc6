// check_case: what only the parts together tell.
#include <map>

#include "coupler/case/case.hpp"
#include "coupler/case/check_parts.hpp"

namespace dipper {

bool check::file_exists(const Case& c, const std::string& key, const std::filesystem::path& file,
                        Findings& findings) {
  if (std::filesystem::is_regular_file(file)) return true;
  findings.push_back(finding_at(c, key, "no such file: " + file.string()));
  return false;
}

std::vector<Finding> check_case(const Case& c) {
  std::vector<Finding> findings;
  std::map<std::string, TriangleMesh> bodies;
  for (const auto& [name, file] : c.bodies) {
    if (auto body = check::load_sound_mesh(c, "bodies." + name, file, findings)) {
      bodies.emplace(name, std::move(*body));
    }
  }
  if (const auto dipper = bodies.find("dipper"); dipper != bodies.end()) {
    check::check_tooth_wear(c, dipper->second, findings);
  }
  if (const auto truck = check::load_sound_mesh(c, "truck.mesh", c.truck.mesh, findings)) {
    check::check_truck_in_domain(c, *truck, findings);
  }
  check::check_mesh_facts(c, findings);
  check::check_pile_in_domain(c, findings);
  if (const auto motion = check::check_motion(c, bodies, findings)) {
    check::check_windows(c, *motion, findings);
  }
  check::check_rock(c, findings);
  return findings;
}

}  // namespace dipper
