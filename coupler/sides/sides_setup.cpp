#include "coupler/sides/sides_setup.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "common/angles.hpp"
#include "common/installation.hpp"
#include "coupler/case/machine_kind.hpp"
#include "coupler/deck/collapse.hpp"
#include "coupler/deck/dig_planner.hpp"
#include "coupler/deck/pile_shape.hpp"

namespace dipper::sides {
namespace fs = std::filesystem;
namespace {

// The cleared floor: beside the pile as far as rock rolls, and to a height above rock lying on it.
constexpr double kFloorSide_m = 4, kFloorHeight_m = 3;

/// Frames are written at ends of sync steps, where the record has a row. LIGGGHTS counts steps in
/// an int, and always writes the first.
long dump_steps(const cases::Case& c) {
  const double window_s = c.coupling.sync_steps * c.dem.timestep_s;
  const long most = std::numeric_limits<int>::max() / c.coupling.sync_steps;
  const double every_s = c.output.dump_every_s;
  const double windows = every_s > 0 ? std::round(every_s / window_s) : HUGE_VAL;
  return std::lround(std::clamp(windows, 1.0, static_cast<double>(most))) * c.coupling.sync_steps;
}

std::vector<std::string> body_names(const cases::Case& c) {
  std::vector<std::string> names;
  for (const auto& body : c.bodies) names.push_back(body.first);
  return names;
}

}  // namespace

MeshFacts read_mesh_facts(const cases::Case& c) {
  std::vector<Finding> findings;
  MeshFacts facts;
  for (const std::string& name : cases::weighed_bodies(c)) {
    const cases::DipperFacts body = cases::read_dipper_facts(c, findings, name);
    if (c.machine.kind == cases::MachineKind::shovel) facts.dipper = body;
    facts.loads[name] = body.load;
  }
  if (cases::has_truck(c)) facts.truck_bed = cases::read_truck_bed(c, findings);
  if (!findings.empty()) throw std::runtime_error(to_string(findings.front()));
  return facts;
}

setup::RockSetup rock_setup(const cases::Case& c, const MeshFacts& facts, const fs::path& deck,
                            const fs::path& dumps, const fs::path& logs, const fs::path& restart,
                            const std::optional<std::vector<setup::WallMemory>>& resumed) {
  setup::RockSetup setup;
  setup.ranks = c.dem.ranks;
  setup.fast_loop = c.dem.loop == cases::RockLoop::fast;
  setup.deck = (data_folder() / "dem_in" / "dig.in").string();
  setup.log = (logs / "dem.liggghts").string();
  setup.screen = (logs / "dem.screen").string();
  setup.resumed = resumed;
  if (resumed) setup.image = setup::image_of(restart);
  setup.variables = {{"deck", deck.string()},
                     {"pile", restart.string()},
                     {"out", dumps.string()},
                     {"run_steps", "0"},
                     {"dump_steps", std::to_string(dump_steps(c))}};
  setup.bodies = body_names(c);
  // The bodies' poses are relative to their own frames.
  for (const std::string& body : setup.bodies)
    for (const char* axis : {"_x", "_y", "_z"}) setup.variables.emplace_back(body + axis, "0");
  if (c.pile.clear_machine) {
    setup.cleared = setup.bodies;
    if (cases::has_truck(c)) setup.cleared.emplace_back("truck");
  }
  setup.pauses = !c.machine.contact_on_return;
  if (c.pile.clean_floor_to_x_m != 0)
    setup.floor = setup::FloorStrip{c.pile.clean_floor_to_x_m, c.pile.width_m / 2 + kFloorSide_m,
                                    kFloorHeight_m};
  if (c.dem.hold_below_m_s > 0) setup.hold.emplace().below_m_s = c.dem.hold_below_m_s;
  if (c.pile.held_layer_m > 0)
    setup.layer =
        setup::HeldLayer{c.pile.held_layer_m, deck::pile_shape(c).rear_x_m, c.pile.width_m / 2};
  Pose X_WT;
  X_WT.p = c.truck.position_m;
  X_WT.R = from_rotation_vector({0, 0, radians(c.truck.heading_deg)});
  for (const auto& [name, load] : facts.loads)
    setup.scales.push_back({"mass_in_" + name, name, Pose{}, load});
  if (facts.truck_bed) setup.scales.push_back({"mass_in_truck", "", X_WT, *facts.truck_bed});
  if (c.crust.tensile_strength_Pa > 0) {
    setup.crust = setup::CrustZone{c.crust.above_m, c.crust.thickness_m};
  }
  if (c.collapse.height_m > 0) {
    const deck::CollapseSlab slab = deck::collapse_slab(c);
    // The case check has refused a slab that never falls.
    const double at_s = deck::collapse_time_s(c, machine::Motion::load(c.machine.motion)).value();
    setup.fall = setup::RockFall{(data_folder() / "dem_in" / "collapse.in").string(),
                                 std::llround(at_s / c.dem.timestep_s), slab.mass_kg};
    for (const auto& v : deck::collapse_variables(slab)) setup.variables.push_back(v);
  }
  return setup;
}

setup::MachineSetup machine_setup(const cases::Case& c, const DipperLayers& layers,
                                  bool program_drives) {
  if (c.machine.kind == cases::MachineKind::poses)
    return setup::PosesSetup{c.machine.poses, body_names(c)};
  setup::ShovelSetup setup;
  setup.model = c.machine.model;
  setup.motion = c.machine.motion;
  setup.planned = c.machine.operated_by == cases::OperatorKind::plan;
  if (setup.planned) setup.full_kg = deck::dig_facts(c).capacity_kg;
  setup.drives = c.machine.drives;
  setup.program_drives = program_drives;
  setup.contact_on_return = c.machine.contact_on_return;
  setup.base_position_m = c.machine.base_position_m;
  setup.rake_angle_deg = c.machine.rake_angle_deg;
  setup.condition.crowd_friction_N = c.machine.crowd_friction_N;
  setup.condition.hoist_loss = c.machine.hoist_loss;
  setup.condition.rope_compliance = c.machine.rope_compliance;
  setup.condition.added_mass_kg = layers.mass_kg;
  setup.condition.added_center_m = layers.center_m;
  setup.condition.added_inertia_kg_m2 = layers.inertia_kg_m2.diagonal();
  return setup;
}

}  // namespace dipper::sides
