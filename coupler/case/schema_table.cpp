// The table of keys. A new key is a member in case.hpp, a line here, and a line of docs/case.md
// (the schema test prints the table to paste). `affects` decides whether a cached pile can be
// used, whether a run may be resumed, and what `dipper replay`, `observe` and `gap` compute.
#include "coupler/case/schema.hpp"

namespace dipper::cases {
namespace {

using core::Scheme;
using machine::DriveMode;

// The ranges catch slips (a density in t/m3, an angle in rad), so they are wide: they contain every
// value that a study may sensibly try.
constexpr Range any{};
constexpr Range place{-1e4, 1e4, false, false};   // m: a coordinate in W
constexpr Range simulated{0, 1e5, false, false};  // s: more than a day
constexpr Range mine{-1e8, 1e8, false, false};    // m: a coordinate of a mine's grid
constexpr Range turn{-360, 360, false, false};
constexpr Range friction{0, 5, false, false};
constexpr Range damping{0, 10, false, false};

Range between(double low, double high) { return {low, high, false, false}; }
Range inside(double low, double high) { return {low, high, true, true}; }
Range up_to(double high) { return {0, high, true, false}; }

SizeClass& class_at(Case& c, const Place& p) {
  if (c.rock.classes.size() <= p.index) c.rock.classes.resize(p.index + 1);
  return c.rock.classes[p.index];
}

// The member `expr` of the case `c`, at the place `p` where the key has a # or *.
#define SLOT(expr) [](Case& c, [[maybe_unused]] const Place& p) -> Slot { return &(expr); }
// The same for a contact number that takes another one's value unless it is given.
#define FOLLOWING(member)                               \
  [](Case& c, const Place&) -> Slot {                   \
    c.contact.member = of_every_pair(c.contact).member; \
    return &*c.contact.member;                          \
  }
// The same for a bool or an enum, with the values of the allowed words, in order.
#define CHOICE(expr, ...) \
  [](Case& c, const Place&) -> Slot { return Choice(expr, std::vector{__VA_ARGS__}); }

// Two lines a key read as a table.
// clang-format off
std::vector<KeySpec> make_schema() {
  constexpr bool required = true;
  constexpr bool optional = false;
  constexpr Affects settling = Affects::settling, dig = Affects::dig, machine = Affects::machine,
                    instruments = Affects::instruments, output = Affects::output;
  return {
      {"format", "", between(1, 1), {}, required, output,
       "version of this file format", SLOT(c.format)},
      {"title", "", any, {}, optional, output,
       "one-line title for reports", SLOT(c.title)},
      {"seed", "", between(0, 2147483647), {}, required, settling,
       "seed of all random choices: sizes, shapes, places and orientations of the rocks",
       SLOT(c.seed)},
      {"end_s", "s", simulated, {}, optional, output,
       "simulated time; default 0: until the motion has ended", SLOT(c.end_s)},

      {"machine.kind", "", any, {"shovel", "poses"}, optional, dig,
       "a rope shovel that follows a motion, or any bodies that follow a table of poses (docs/poses.md); shovel",
       CHOICE(c.machine.kind, MachineKind::shovel, MachineKind::poses)},
      {"machine.poses", "", any, {}, optional, dig,
       "of kind poses: poses of every body against time, CSV", SLOT(c.machine.poses)},
      {"machine.model", "", any, {}, required, dig,
       "machine file: dimensions, masses and drives of the shovel", SLOT(c.machine.model)},
      {"machine.motion", "", any, {}, required, dig,
       "CSV of the drives' positions against time", SLOT(c.machine.motion)},
      {"machine.drives", "", any, {"prescribed", "limited"}, optional, dig,
       "hoist, crowd and swing: prescribed (exactly as the motion says) or limited (as far "
       "as their motors can); default prescribed",
       CHOICE(c.machine.drives, DriveMode::prescribed, DriveMode::limited)},
      {"machine.operator", "", any, {"motion", "plan"}, optional, dig,
       "who drives: motion (follows machine.motion) or plan (plans each pass on the face that is there; docs/operator.md); default motion",
       CHOICE(c.machine.operated_by, OperatorKind::motion, OperatorKind::plan)},
      {"machine.plan", "", any, {}, optional, dig,
       "of operator plan: the cycle and the digs to choose from, YAML", SLOT(c.machine.plan)},
      {"machine.base_position_m", "m", place, {}, required, dig,
       "swing axis at ground level, in W", SLOT(c.machine.base_position_m)},
      {"machine.rake_angle_deg", "deg", turn, {}, required, dig,
       "angle of the dipper against the handle (paper, Fig. 4b)", SLOT(c.machine.rake_angle_deg)},
      {"machine.contact_on_return", "", any, {"on", "off"}, optional, dig,
       "whether the dipper touches rock on its return from the truck; default on",
       CHOICE(c.machine.contact_on_return, true, false)},
      {"machine.crowd_friction_N", "N", between(0, 1e8), {}, optional, machine,
       "Coulomb friction of the crowd's slide; default 0", SLOT(c.machine.crowd_friction_N)},
      {"machine.hoist_loss", "", between(0, 0.5), {}, optional, machine,
       "fraction of the hoist rope's tension lost in the sheaves; default 0",
       SLOT(c.machine.hoist_loss)},
      {"machine.rope_compliance", "", between(1e-3, 100), {}, optional, dig,
       "stretch of the hoist ropes, as a multiple of the machine file's; default 1",
       SLOT(c.machine.rope_compliance)},
      {"machine.liner_thickness_m", "m", between(0, 0.5), {}, optional, dig,
       "thickness of steel liners on the dipper's floor, roof and sides; default 0",
       SLOT(c.machine.liner_thickness_m)},
      {"machine.carry_back_m", "m", between(0, 0.7), {}, optional, dig,
       "thickness of rock that sticks to the dipper's floor; default 0",
       SLOT(c.machine.carry_back_m)},
      {"machine.tooth_wear_m", "m", between(0, 1), {}, optional, dig,
       "length that the dipper's teeth have lost; default 0", SLOT(c.machine.tooth_wear_m)},

      {"operator.goal", "", any, {"time", "energy"}, optional, dig,
       "what operator plan maximises: payload per time or per energy; default time",
       CHOICE(c.op.goal, machine::DigGoal::time, machine::DigGoal::energy)},
      {"operator.passes", "", between(1, 1000), {}, optional, dig,
       "passes at most; default 10", SLOT(c.op.passes)},
      {"operator.least_fill", "", between(0, 1), {}, optional, dig,
       "fraction of a full dipper; operator plan digs no pass that is expected to load less; default 0.3",
       SLOT(c.op.least_fill)},
      {"operator.scan_error_m", "m", between(0, 10), {}, optional, dig,
       "standard error of the heights of the face that the operator sees; default 0",
       SLOT(c.op.scan_error_m)},
      {"operator.scan_dead_angle_deg", "deg", between(0, 89), {}, optional, dig,
       "rock whose surface the line of sight meets at less than this angle is hidden from the operator; default 0",
       SLOT(c.op.scan_dead_angle_deg)},

      {"rock.density_kg_m3", "kg/m3", between(100, 20000), {}, required, settling,
       "density of solid rock, not of the pile", SLOT(c.rock.density_kg_m3)},
      {"rock.bulk_density_kg_m3", "kg/m3", between(100, 20000), {}, required, settling,
       "density of the settled pile, for fill factor, voids and the estimate without rock",
       SLOT(c.rock.bulk_density_kg_m3)},
      {"rock.youngs_modulus_Pa", "Pa", between(1e5, 1e12), {}, required, settling,
       "Young's modulus of solid rock, before contact.normal_scale",
       SLOT(c.rock.youngs_modulus_Pa)},
      {"rock.poisson_ratio", "", inside(0, 0.5), {}, required, settling,
       "Poisson's ratio of solid rock", SLOT(c.rock.poisson_ratio)},
      {"rock.coarse_graining", "", between(0.1, 100), {}, required, settling,
       "factor on every rock size; 1 is true size", SLOT(c.rock.coarse_graining)},
      {"rock.fines_fraction", "", between(0, 1), {}, optional, settling,
       "fraction of the voids filled with fines, which add mass and move with the rock; default 0",
       SLOT(c.rock.fines_fraction)},
      {"rock.coarse_graining_limit_m", "m", between(0, 100), {}, optional, settling,
       "coarse_graining enlarges no class beyond this size and leaves larger ones alone; "
       "default 0: no limit",
       SLOT(c.rock.coarse_graining_limit_m)},
      {"rock.shape_folder", "", any, {}, required, settling,
       "folder of the rock shapes, NAME.stl (a closed scan) or NAME.yaml (made from one)",
       SLOT(c.rock.shape_folder)},
      {"rock.shape_resolution", "", any, {"coarse", "medium", "fine"}, optional, settling,
       "spheres per rock: 6, 12 or 24 (docs/rock.md); default coarse",
       SLOT(c.rock.shape_resolution)},
      {"rock.classes.#.name", "", any, {}, required, settling,
       "name of the size class in outputs", SLOT(class_at(c, p).name)},
      {"rock.classes.#.size_m", "m", between(0.001, 10), {}, required, settling,
       "diameter of the sphere of the same volume, before coarse_graining",
       SLOT(class_at(c, p).size_m)},
      {"rock.classes.#.mass_percent", "%", up_to(100), {}, required, settling,
       "percentage of the rock's mass; the classes add up to 100", SLOT(class_at(c, p).mass_percent)},
      {"rock.classes.#.shapes", "", any, {}, required, settling,
       "`sphere`, or names of shapes in shape_folder, in equal parts",
       SLOT(class_at(c, p).shapes)},

      {"rock.sieve.file", "", any, {}, optional, settling,
       "CSV size_m,passing_percent that gives the classes, in place of rock.classes",
       SLOT(c.rock.sieve.file)},
      {"rock.sieve.classes", "", between(1, 50), {}, optional, settling,
       "number of size classes made from the curve; default 5", SLOT(c.rock.sieve.classes)},
      {"rock.sieve.min_size_m", "m", between(0, 10), {}, optional, settling,
       "smaller rock counts as the smallest class; default 0: the curve's smallest size",
       SLOT(c.rock.sieve.min_size_m)},
      {"rock.sieve.max_size_m", "m", between(0, 10), {}, optional, settling,
       "larger rock counts as the largest class; default 0: the curve's largest size",
       SLOT(c.rock.sieve.max_size_m)},
      {"rock.sieve.spheres_below_m", "m", between(0, 10), {}, optional, settling,
       "classes below this size are spheres; default 0", SLOT(c.rock.sieve.spheres_below_m)},
      {"rock.sieve.shapes", "", any, {}, optional, settling,
       "shapes in shape_folder for the other classes; default: spheres",
       SLOT(c.rock.sieve.shapes)},

      {"contact.normal_scale", "", up_to(10), {}, required, settling,
       "factor C_norm on the normal stiffness (paper, Eq. 4)", SLOT(c.contact.normal_scale)},
      {"contact.tangential_scale", "", up_to(10), {}, required, settling,
       "C_tan: tangential over normal stiffness, K_t = C_tan K_n",
       SLOT(c.contact.tangential_scale)},
      {"contact.normal_damping", "", damping, {}, required, settling,
       "normal damping D_n, as a fraction of critical (paper, Eq. 6)",
       SLOT(c.contact.normal_damping)},
      {"contact.tangential_damping", "", damping, {}, required, settling,
       "tangential damping D_t, as a fraction of critical", SLOT(c.contact.tangential_damping)},
      {"contact.normal_damping_other", "", damping, {}, optional, settling,
       "D_n of all pairs except sphere on sphere; default: normal_damping",
       FOLLOWING(normal_damping_other)},
      {"contact.tangential_damping_other", "", damping, {}, optional, settling,
       "D_t of all pairs except sphere on sphere; default: tangential_damping",
       FOLLOWING(tangential_damping_other)},
      {"contact.friction_sphere_sphere", "", friction, {}, required, settling,
       "friction coefficient, sphere on sphere (paper, Eq. 7)",
       SLOT(c.contact.friction_sphere_sphere)},
      {"contact.friction_sphere_rock", "", friction, {}, required, settling,
       "friction coefficient, sphere on rock", SLOT(c.contact.friction_sphere_rock)},
      {"contact.friction_rock_rock", "", friction, {}, required, settling,
       "friction coefficient, rock on rock", SLOT(c.contact.friction_rock_rock)},
      {"contact.friction_dipper", "", friction, {}, required, settling,
       "friction coefficient, spheres and rocks on any body", SLOT(c.contact.friction_dipper)},
      {"contact.friction_ground", "", friction, {}, required, settling,
       "friction coefficient, spheres and rocks on the ground", SLOT(c.contact.friction_ground)},
      {"contact.friction_truck", "", friction, {}, required, settling,
       "friction coefficient, spheres and rocks on the truck", SLOT(c.contact.friction_truck)},
      {"contact.friction_truck_sphere", "", friction, {}, optional, settling,
       "friction coefficient, spheres on the truck; default: friction_truck",
       FOLLOWING(friction_truck_sphere)},
      {"contact.rolling_friction_sphere", "", friction, {}, required, settling,
       "rolling friction, sphere on sphere (paper, Eq. 8)",
       SLOT(c.contact.rolling_friction_sphere)},
      {"contact.rolling_friction_rock", "", friction, {}, optional, settling,
       "rolling friction, spheres on rocks; default: rolling_friction_sphere",
       FOLLOWING(rolling_friction_rock)},
      {"contact.rolling_friction_dipper", "", friction, {}, optional, settling,
       "rolling friction, spheres on bodies; default: rolling_friction_sphere",
       FOLLOWING(rolling_friction_dipper)},
      {"contact.rolling_friction_ground", "", friction, {}, required, settling,
       "rolling friction, spheres on the ground", SLOT(c.contact.rolling_friction_ground)},
      {"contact.rolling_friction_truck", "", friction, {}, optional, settling,
       "rolling friction, spheres on the truck; default: rolling_friction_ground",
       FOLLOWING(rolling_friction_truck)},
      {"contact.cohesion_Pa", "Pa", between(0, 1e6), {}, optional, settling,
       "tensile strength of the moist pile; default 0", SLOT(c.contact.cohesion_Pa)},
      {"contact.adhesion_Pa", "Pa", between(0, 1e6), {}, optional, settling,
       "tensile strength between moist rock and bodies or truck; default 0",
       SLOT(c.contact.adhesion_Pa)},

      {"crust.tensile_strength_Pa", "Pa", between(0, 1e8), {}, optional, dig,
       "tensile strength of the bonds in a frozen or compacted crust; broken bonds do not "
       "heal; default 0: no crust",
       SLOT(c.crust.tensile_strength_Pa)},
      {"crust.shear_ratio", "", between(0.1, 10), {}, optional, dig,
       "shear strength of a bond over its tensile strength; default 1", SLOT(c.crust.shear_ratio)},
      {"crust.above_m", "m", place, {}, optional, dig,
       "height above which rock is in the crust; default 0", SLOT(c.crust.above_m)},
      {"crust.thickness_m", "m", between(0, 1e4), {}, optional, dig,
       "depth of the crust, straight down from the surface; default 0: no limit",
       SLOT(c.crust.thickness_m)},

      {"pile.profile", "", any, {}, optional, settling,
       "scanned section (CSV x_m,z_m from toe to rear) or surface (STL, z over x and y), in "
       "W, to which the bench is cut; replaces the keys marked *",
       SLOT(c.pile.profile)},
      {"pile.toe_x_m", "m", place, {}, required, settling,
       "* x at which the settled face should meet the ground, in W", SLOT(c.pile.toe_x_m)},
      {"pile.height_m", "m", up_to(100), {}, required, settling,
       "* height of the bench behind the crest", SLOT(c.pile.height_m)},
      {"pile.width_m", "m", up_to(500), {}, required, settling,
       "width along y, centred on y = 0, between frictionless planes", SLOT(c.pile.width_m)},
      {"pile.crest_depth_m", "m", up_to(500), {}, required, settling,
       "* length of the flat top between the crest and the rear wall", SLOT(c.pile.crest_depth_m)},
      {"pile.face_angle_deg", "deg", inside(0, 90), {}, required, settling,
       "* angle of the retaining sheet while the rock settles", SLOT(c.pile.face_angle_deg)},
      {"pile.built", "", any, {"poured", "bricks"}, optional, settling,
       "poured: the whole bench settles behind a sheet; bricks: it is laid from a block of its rock that settled once (docs/rock.md); default poured",
       CHOICE(c.pile.built, PileBuilt::poured, PileBuilt::bricks)},
      {"pile.settle_s", "s", between(0, 1e4), {}, required, settling,
       "settling time with the sheet, or of a brick", SLOT(c.pile.settle_s)},
      {"pile.relax_s", "s", between(0, 1e4), {}, required, settling,
       "settling time without the sheet, or of a bench of bricks", SLOT(c.pile.relax_s)},
      {"pile.held_layer_m", "m", between(0, 10), {}, optional, dig,
       "rock within this distance of the ground, the rear and the side walls is held fixed "
       "in the dig; default 0: none",
       SLOT(c.pile.held_layer_m)},
      {"pile.clear_machine", "", any, {"off", "on"}, optional, dig,
       "whether rock that overlaps dipper, door or truck at the start is removed; default off",
       CHOICE(c.pile.clear_machine, false, true)},
      {"pile.clean_floor_to_x_m", "m", place, {}, optional, dig,
       "rock on the floor in front of this x is removed at the end of each return without "
       "rock; default 0: it stays",
       SLOT(c.pile.clean_floor_to_x_m)},

      {"collapse.height_m", "m", between(0, 20), {}, optional, dig,
       "height of a slab over the bench's upper half that comes down during the dig; default "
       "0: none",
       SLOT(c.collapse.height_m)},
      {"collapse.at_s", "s", simulated, {}, optional, dig,
       "time at which the slab comes down; default 0: when the door first opens",
       SLOT(c.collapse.at_s)},

      {"bodies.*", "", any, {}, required, dig,
       "name of a moving body, and its wall mesh: STL in m, in the body's own frame",
       SLOT(c.bodies[p.name])},

      {"truck.mesh", "", any, {}, required, dig,
       "wall mesh of the truck: STL in m", SLOT(c.truck.mesh)},
      {"truck.position_m", "m", place, {}, required, dig,
       "origin of the truck mesh, in W", SLOT(c.truck.position_m)},
      {"truck.heading_deg", "deg", turn, {}, optional, dig,
       "rotation of the truck about z; default 0", SLOT(c.truck.heading_deg)},
      {"truck.rated_t", "t", between(0, 1000), {}, optional, dig,
       "rated payload of the truck: passes to fill it, under- and overload, and where operator plan stops; default 0: not given",
       SLOT(c.truck.rated_t)},

      {"site.origin_m", "m", mine, {}, optional, output,
       "easting, northing and elevation of W's origin in the mine's grid, for dipper survey; "
       "default [0, 0, 0]",
       SLOT(c.site.origin_m)},
      {"site.azimuth_deg", "deg", turn, {}, optional, output,
       "direction of W's x, clockwise from grid north, for dipper survey; default 90: east",
       SLOT(c.site.azimuth_deg)},

      {"domain.min_m", "m", place, {}, required, settling,
       "lower corner of the DEM box, in W", SLOT(c.domain.min_m)},
      {"domain.max_m", "m", place, {}, required, settling,
       "upper corner of the DEM box, in W", SLOT(c.domain.max_m)},

      {"dem.timestep_s", "s", up_to(0.1), {"auto"}, required, settling,
       "DEM step, below the largest stable one, which `dipper check` prints; auto: 0.85 of it, to two digits",
       SLOT(c.dem.timestep_s)},
      {"dem.ranks", "", between(1, 4096), {}, optional, settling,
       "number of MPI processes; default 1", SLOT(c.dem.ranks)},
      {"dem.loop", "", any, {"fast", "liggghts"}, optional, settling,
       "DEM time steps by Dipper's faster loop or by LIGGGHTS's own (docs/coupling.md); "
       "default fast",
       CHOICE(c.dem.loop, RockLoop::fast, RockLoop::liggghts)},
      {"dem.hold_below_m_s", "m/s", between(0, 1), {}, optional, dig,
       "rock slower than this, far from the machine, is held until something approaches; "
       "default 0: off",
       SLOT(c.dem.hold_below_m_s)},

      {"coupling.scheme", "", any, {"corrected", "serial"}, required, dig,
       "how a sync step is computed (docs/coupling.md)",
       CHOICE(c.coupling.scheme, Scheme::corrected, Scheme::serial)},
      {"coupling.sync_steps", "", between(1, 1000000), {}, required, dig,
       "DEM steps per sync step", SLOT(c.coupling.sync_steps)},
      {"coupling.timeout_s", "s", between(1, 86400), {}, required, output,
       "wall time without a reply after which a side counts as failed",
       SLOT(c.coupling.timeout_s)},

      {"output.dump_every_s", "s", simulated, {}, required, output,
       "simulated time between dumps of rock and walls; 0: only at the start",
       SLOT(c.output.dump_every_s)},
      {"output.checkpoint_every_s", "s", simulated, {}, optional, output,
       "simulated time between checkpoints; default 0: only when interrupted",
       SLOT(c.output.checkpoint_every_s)},
      {"output.wall_stress", "", any, {"off", "on"}, optional, output,
       "whether the bodies' dumps have pressure and shear of each triangle; default off",
       CHOICE(c.output.wall_stress, false, true)},
      {"output.wear_m3_J", "m3/J", between(0, 1), {}, optional, dig,
       "Finnie's coefficient, for the worn depth of each triangle in the bodies' dumps; "
       "default 0: none",
       SLOT(c.output.wear_m3_J)},

      {"observation.rate_Hz", "Hz", up_to(1000), {}, optional, instruments,
       "sampling rate of the drives' logger, in observed/; default 1", SLOT(c.observation.rate_Hz)},
      {"observation.lag_s", "s", between(-10, 10), {}, optional, instruments,
       "delay of the logger's forces against its motion; default 0",
       SLOT(c.observation.lag_s)},
      {"observation.scale_gain", "", between(-0.5, 0.5), {}, optional, instruments,
       "the truck scale reads 1 + this times the mass; default 0", SLOT(c.observation.scale_gain)},
      {"observation.truck_spillage", "", between(0, 1), {}, optional, instruments,
       "fraction of the last pass that falls off the truck before it is weighed; default 0",
       SLOT(c.observation.truck_spillage)},
      {"observation.scale_offset_t", "t", between(-50, 50), {}, optional, instruments,
       "added to the truck scale's reading of each pass; default 0",
       SLOT(c.observation.scale_offset_t)},
      {"observation.hoist_cell_gain", "", between(-0.5, 0.5), {}, optional, instruments,
       "the hoist's force reads 1 + this times its value; default 0",
       SLOT(c.observation.hoist_cell_gain)},
      {"observation.crowd_cell_gain", "", between(-0.5, 0.5), {}, optional, instruments,
       "the crowd's force reads 1 + this times its value; default 0",
       SLOT(c.observation.crowd_cell_gain)},
      {"observation.door_leak", "", between(0, 1), {}, optional, instruments,
       "fraction of each load that a leaking door loses between breakout and dump; default 0",
       SLOT(c.observation.door_leak)},
      {"observation.hoist_law.*", "", between(-1e5, 1e5), {}, optional, instruments,
       "force added to the hoist's reading, by term of the motion (docs/gap_method.md)",
       SLOT(c.observation.hoist_law[p.name])},
      {"observation.crowd_law.*", "", between(-1e5, 1e5), {}, optional, instruments,
       "likewise the crowd", SLOT(c.observation.crowd_law[p.name])},

      {"effects.*", "", any, {}, optional, settling,
       "strength of an effect in analysis/effects or in the case's own effects folder",
       SLOT(c.effects[p.name])},
  };
}
// clang-format on

#undef CHOICE
#undef SLOT

}  // namespace

const std::vector<KeySpec>& schema() {
  static const std::vector<KeySpec> keys = make_schema();
  return keys;
}

}  // namespace dipper::cases
