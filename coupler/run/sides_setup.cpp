#include "coupler/run/sides_setup.hpp"

#include <fmt/core.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>

#include "coupler/deck/collapse.hpp"
#include "coupler/deck/pile_shape.hpp"
#include "coupler/dem/rock_setup.hpp"
#include "coupler/run/installation.hpp"

namespace dipper {
namespace fs = std::filesystem;
namespace {

Eigen::Vector3d vector(const YAML::Node& node) {
  const auto v = node.as<std::array<double, 3>>();
  return {v[0], v[1], v[2]};
}

BoundingBox box(const YAML::Node& node) { return {vector(node["min_m"]), vector(node["max_m"])}; }

/// Frames fall on ends of sync steps, where the record has a row.
long dump_steps(const Case& c) {
  const double window_s = c.coupling.sync_steps * c.dem.timestep_s;
  return std::max(1L, std::lround(c.output.dump_every_s / window_s)) * c.coupling.sync_steps;
}

fs::path beside(fs::path mesh) { return mesh.replace_extension(".yaml"); }

}  // namespace

MeshFacts read_mesh_facts(const Case& c) {
  MeshFacts facts;
  fs::path file = beside(c.bodies.at("dipper"));
  try {
    const YAML::Node dipper = YAML::LoadFile(file);
    facts.struck_volume_m3 = dipper["struck_volume_m3"].as<double>();
    facts.cavity = box(dipper["cavity"]);
    facts.dipper_load = facts.cavity;
    facts.dipper_load.max.x() += dipper["heap_height_m"].as<double>();
    file = beside(c.truck.mesh);
    facts.truck_bed = box(YAML::LoadFile(file)["bed"]);
  } catch (const YAML::Exception& e) {
    throw std::runtime_error(fmt::format(
        "{}:{}: {}; beside a dipper's mesh: struck_volume_m3, cavity: {{min_m, max_m}}, "
        "heap_height_m; beside a truck's: bed: {{min_m, max_m}}",
        file.string(), e.mark.line + 1, e.msg));
  }
  return facts;
}

nlohmann::json dem_settings(const Case& c, const MeshFacts& facts, const fs::path& deck,
                            const fs::path& dumps, const fs::path& logs, const fs::path& restart,
                            const std::optional<std::vector<WallMemory>>& resumed) {
  RockSetup setup;
  setup.deck = (source_folder() / "dem_in" / "dig.in").string();
  setup.log = (logs / "dem.liggghts").string();
  setup.screen = (logs / "dem.screen").string();
  setup.resumed = resumed;
  setup.variables = {{"deck", deck.string()},
                     {"pile", restart.string()},
                     {"out", dumps.string()},
                     {"run_steps", "0"},
                     {"dump_steps", std::to_string(dump_steps(c))},
                     // The bodies are placed by their own poses, from their own frames.
                     {"dipper_x", "0"},
                     {"dipper_y", "0"},
                     {"dipper_z", "0"},
                     {"door_z", "0"}};
  setup.bodies = {"dipper", "door"};
  if (c.pile.clear_machine == "on") setup.cleared = {"dipper", "door", "truck"};
  if (c.dem.hold_below_m_s > 0) setup.hold.emplace().below_m_s = c.dem.hold_below_m_s;
  if (c.pile.held_layer_m > 0)
    setup.layer = HeldLayer{c.pile.held_layer_m, pile_shape(c).rear_x_m, c.pile.width_m / 2};
  Pose X_WT;
  X_WT.p = c.truck.position_m;
  X_WT.R = from_rotation_vector({0, 0, c.truck.heading_deg * M_PI / 180});
  setup.scales = {
      {"mass_in_dipper", "dipper", Pose{}, facts.dipper_load.min, facts.dipper_load.max},
      {"mass_in_truck", "", X_WT, facts.truck_bed.min, facts.truck_bed.max}};
  if (c.crust.tensile_strength_Pa > 0) {
    setup.crust = CrustZone{c.crust.above_m, c.crust.thickness_m};
  }
  if (c.collapse.height_m > 0) {
    const CollapseSlab slab = collapse_slab(c);
    // The check has refused a case whose slab never comes loose.
    const double at_s = collapse_time_s(c, Motion::load(c.machine.motion)).value();
    setup.fall = RockFall{(source_folder() / "dem_in" / "collapse.in").string(),
                          std::llround(at_s / c.dem.timestep_s), slab.mass_kg};
    for (const auto& v : collapse_variables(slab)) setup.variables.push_back(v);
  }
  return to_json(setup);
}

nlohmann::json mbs_settings(const Case& c, const DipperLayers& layers) {
  const auto list = [](const Eigen::Vector3d& v) { return std::array{v.x(), v.y(), v.z()}; };
  return {{"model", c.machine.model.string()},
          {"motion", c.machine.motion.string()},
          {"base_position_m", list(c.machine.base_position_m)},
          {"rake_angle_deg", c.machine.rake_angle_deg},
          {"crowd_friction_N", c.machine.crowd_friction_N},
          {"hoist_loss", c.machine.hoist_loss},
          {"rope_compliance", c.machine.rope_compliance},
          {"added_mass_kg", layers.mass_kg},
          {"added_center_m", list(layers.center_m)},
          {"added_inertia_kg_m2", list(layers.inertia_kg_m2.diagonal())}};
}

}  // namespace dipper
