#include "coupler/setup/machine_setup.hpp"

#include <string>

#include "common/json_values.hpp"

namespace dipper::setup {

using machine::DriveMode;
using nlohmann::json;

namespace {

json json_of_setup(const ShovelSetup& s) {
  return {{"kind", "shovel"},
          {"model", s.model.string()},
          {"motion", s.motion.string()},
          {"planned", s.planned},
          {"full_kg", s.full_kg},
          {"limited_drives", s.drives == DriveMode::limited},
          {"program_drives", s.program_drives},
          {"contact_on_return", s.contact_on_return},
          {"base_position_m", json_of(s.base_position_m)},
          {"rake_angle_deg", s.rake_angle_deg},
          {"crowd_friction_N", s.condition.crowd_friction_N},
          {"hoist_loss", s.condition.hoist_loss},
          {"rope_compliance", s.condition.rope_compliance},
          {"added_mass_kg", s.condition.added_mass_kg},
          {"added_center_m", json_of(s.condition.added_center_m)},
          {"added_inertia_kg_m2", json_of(s.condition.added_inertia_kg_m2)}};
}

json json_of_setup(const PosesSetup& s) {
  return {{"kind", "poses"}, {"table", s.table.string()}, {"bodies", s.bodies}};
}

ShovelSetup shovel_from(const json& j) {
  ShovelSetup s;
  s.model = j.at("model").get<std::string>();
  s.motion = j.at("motion").get<std::string>();
  s.full_kg = j.at("full_kg");
  s.planned = j.at("planned");
  s.drives = j.at("limited_drives").get<bool>() ? DriveMode::limited : DriveMode::prescribed;
  s.program_drives = j.at("program_drives");
  s.contact_on_return = j.at("contact_on_return");
  s.base_position_m = vector_from(j.at("base_position_m"));
  s.rake_angle_deg = j.at("rake_angle_deg");
  s.condition.crowd_friction_N = j.at("crowd_friction_N");
  s.condition.hoist_loss = j.at("hoist_loss");
  s.condition.rope_compliance = j.at("rope_compliance");
  s.condition.added_mass_kg = j.at("added_mass_kg");
  s.condition.added_center_m = vector_from(j.at("added_center_m"));
  s.condition.added_inertia_kg_m2 = vector_from(j.at("added_inertia_kg_m2"));
  return s;
}

}  // namespace

json to_json(const MachineSetup& setup) {
  return std::visit([](const auto& s) { return json_of_setup(s); }, setup);
}

MachineSetup machine_setup_from(const json& j) {
  if (j.at("kind") == "shovel") return shovel_from(j);
  return PosesSetup{j.at("table").get<std::string>(), j.at("bodies")};
}

}  // namespace dipper::setup
