#include "coupler/case/mesh_facts.hpp"

#include <fmt/format.h>

#include <string>

#include "common/yaml_section.hpp"

namespace dipper::cases {
namespace fs = std::filesystem;
namespace {

/// The file beside a mesh. `mesh_key` is the case's key that names the mesh, `keys` what the file
/// must hold.
YamlTree read_beside(const Case& c, const std::string& mesh_key, fs::path mesh,
                     const std::string& keys, std::vector<Finding>& findings) {
  const fs::path file = mesh.replace_extension(".yaml");
  if (fs::is_regular_file(file)) return read_yaml(file, findings);
  findings.push_back(
      finding_at(c, mesh_key,
                 fmt::format("cannot read {}; write beside the mesh a file of that name with {}",
                             file.string(), keys)));
  return {};
}

Box read_box(YamlSection& file, const std::string& key, const std::string& what,
             std::vector<Finding>& findings) {
  YamlSection section = file.section(key, "{min_m, max_m}, " + what);
  const std::size_t before = findings.size();
  const Box b{section.vector("min_m", "three numbers in m"),
              section.vector("max_m", "three numbers in m")};
  for (int i = 0; i < 3 && section.is_there() && findings.size() == before; ++i) {
    if (b.min_m[i] < b.max_m[i]) continue;
    section.fault(section.node(), "min_m",
                  fmt::format("{} = {} is not below max_m's {}", "xyz"[i], b.min_m[i], b.max_m[i]));
  }
  return b;
}

}  // namespace

std::vector<std::string> weighed_bodies(const Case& c) {
  std::vector<std::string> names;
  for (const auto& [name, mesh] : c.bodies)
    if (c.machine.kind == MachineKind::shovel
            ? name == "dipper"
            : fs::is_regular_file(fs::path(mesh).replace_extension(".yaml")))
      names.push_back(name);
  return names;
}

DipperFacts read_dipper_facts(const Case& c, std::vector<Finding>& findings,
                              const std::string& name) {
  const std::size_t before = findings.size();
  const YamlTree tree =
      read_beside(c, "bodies." + name, c.bodies.at(name),
                  "struck_volume_m3, cavity: {min_m, max_m}, heap_height_m", findings);
  DipperFacts facts;
  if (findings.size() > before) return facts;
  YamlSection file(tree, "", findings, "struck_volume_m3, cavity: {min_m, max_m}, heap_height_m");
  facts.struck_volume_m3 =
      file.number("struck_volume_m3", "the volume in m3 up to the plane through lip and roof",
                  {0, 1e300, true});
  facts.cavity =
      read_box(file, "cavity", "corners of the inside in the body's own frame", findings);
  facts.load = facts.cavity;
  facts.load.max_m.x() +=
      file.number("heap_height_m", "how far in m rock beyond the lip counts as load", {0});
  return facts;
}

Box read_truck_bed(const Case& c, std::vector<Finding>& findings) {
  const std::size_t before = findings.size();
  const YamlTree tree = read_beside(c, "truck.mesh", c.truck.mesh, "bed: {min_m, max_m}", findings);
  if (findings.size() > before) return {};
  YamlSection file(tree, "", findings, "bed: {min_m, max_m}");
  return read_box(file, "bed",
                  "corners of the box in the mesh's frame whose rock is the truck's load",
                  findings);
}

}  // namespace dipper::cases
