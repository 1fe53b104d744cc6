// A case: what a user edits. One struct a section of case.yaml, one member a key, the key's unit in
// its name. Relative paths are relative to the case folder; here they are absolute.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/box.hpp"
#include "common/finding.hpp"
#include "common/input_error.hpp"
#include "coupler/core/coupling.hpp"
#include "machine/machine_data.hpp"

namespace dipper::cases {

class BenchSurface;

enum class MachineKind {
  shovel,  ///< a rope shovel, its drives led along a motion
  poses    ///< any bodies, led along a table of poses
};

/// Who drives a shovel.
enum class OperatorKind {
  motion,  ///< goes along machine.motion, whatever the face is
  plan     ///< looks at the face before each pass and plans it (machine/pass_choice.hpp)
};

/// machine: what moves the bodies.
struct MachineCase {
  MachineKind kind = MachineKind::shovel;
  std::filesystem::path poses;   ///< of kind poses (machine/pose_table.hpp)
  std::filesystem::path model;   ///< dimensions and masses (mbs/*.yaml)
  std::filesystem::path motion;  ///< drive curves (time_s, hoist_m, crowd_m, swing_deg, door_deg)
  Eigen::Vector3d base_position_m = Eigen::Vector3d::Zero();  ///< swing axis at ground level, in W
  double rake_angle_deg = 0;  ///< dipper against handle (paper, Fig. 4b)
  /// Exactly as the motion says, or as far as they can (docs/drives.md).
  machine::DriveMode drives = machine::DriveMode::prescribed;
  OperatorKind operated_by = OperatorKind::motion;
  std::filesystem::path plan;  ///< of an operator who plans: the cycle, and the digs to choose from
  /// false: the dipper meets no rock from the truck back to the next dig (machine/return_legs.hpp).
  bool contact_on_return = true;

  // Differences of this machine from its data sheet; none by default.
  double crowd_friction_N = 0;   ///< Coulomb friction of the crowd's slide
  double hoist_loss = 0;         ///< of the hoist rope's tension, lost in the sheaves
  double rope_compliance = 1;    ///< stretch of the ropes, as a multiple of the model's
  double liner_thickness_m = 0;  ///< steel on the dipper's floor, roof and sides
  double carry_back_m = 0;       ///< rock that sticks to the dipper's floor, this thick
  double tooth_wear_m = 0;       ///< lost length of the teeth
};

/// operator: what an operator who plans goes by.
struct OperatorCase {
  machine::DigGoal goal = machine::DigGoal::time;  ///< the most payload for time, or for energy
  int passes = 10;                                 ///< at most
  double least_fill = 0.3;  ///< of the dipper: a pass that is expected to load less does not pay
  double scan_error_m = 0;  ///< standard error of a height that is seen
  double scan_dead_angle_deg = 0;  ///< rock that is seen at less than this is not seen
};

/// rock.classes[]: one size of the distribution (paper, Table 1). One LIGGGHTS atom type each.
struct SizeClass {
  std::string name;
  double size_m = 0;                ///< diameter of the sphere of the same volume, before grading
  double mass_percent = 0;          ///< of all rock; the classes add up to 100
  std::vector<std::string> shapes;  ///< "sphere", or names of shapes in shape_folder
};

/// rock.sieve: a measured size distribution, in place of rock.classes (coupler/case/sieve.hpp).
struct SieveCase {
  std::filesystem::path file;  ///< CSV: size_m, passing_percent; empty: none
  int classes = 5;             ///< number of classes made from the curve
  double min_size_m = 0;       ///< finer rock is counted in the smallest class; 0: the curve's
  double max_size_m = 0;       ///< coarser rock is counted in the largest class; 0: the curve's
  double spheres_below_m = 0;  ///< classes below are spheres
  std::vector<std::string> shapes;  ///< of the other classes; empty: spheres
};

/// rock: the material of a single rock.
struct RockCase {
  double density_kg_m3 = 0;
  double bulk_density_kg_m3 = 0;  ///< of the settled pile: fill factor, voids, estimate
  double youngs_modulus_Pa = 0;
  double poisson_ratio = 0;
  double coarse_graining = 1;          ///< every size is multiplied by this
  double fines_fraction = 0;           ///< of the voids, filled with fines that move with the rock
  std::filesystem::path shape_folder;  ///< folder of the shapes' files (meshes/rocks)
  double coarse_graining_limit_m = 0;  ///< no size is grown beyond this; 0: none
  std::string shape_resolution = "coarse";  ///< spheres a rock: coarse, medium or fine
  std::vector<SizeClass> classes;
  SieveCase sieve;  ///< the origin of the classes, if they come from a curve
};

/// contact: Eqs. 3-8 of the paper; one number for each kind of pair. A missing one takes another's
/// value, by of_every_pair.
struct ContactCase {
  double normal_scale = 0;                     ///< C_norm, Eq. 4
  double tangential_scale = 0;                 ///< C_tan: K_t = C_tan K_n
  double normal_damping = 0;                   ///< D_n, of critical, Eq. 6; spheres with spheres
  double tangential_damping = 0;               ///< D_t
  std::optional<double> normal_damping_other;  ///< of every other pair
  std::optional<double> tangential_damping_other;
  double friction_sphere_sphere = 0;  ///< Eq. 7
  double friction_sphere_rock = 0;
  double friction_rock_rock = 0;
  double friction_dipper = 0;
  double friction_ground = 0;
  double friction_truck = 0;
  std::optional<double> friction_truck_sphere;    ///< spheres on the truck; else friction_truck
  double rolling_friction_sphere = 0;             ///< Eq. 8; spheres with spheres
  std::optional<double> rolling_friction_rock;    ///< spheres on rocks; else as with spheres
  std::optional<double> rolling_friction_dipper;  ///< spheres on bodies; else as with spheres
  double rolling_friction_ground = 0;             ///< spheres on the ground
  std::optional<double> rolling_friction_truck;   ///< spheres on the truck; else as on the ground
  double cohesion_Pa = 0;                         ///< tensile strength of the moist pile
  double adhesion_Pa = 0;                         ///< the same against bodies and truck
};

/// The same with a value for every number.
ContactCase of_every_pair(ContactCase contact);

/// crust: rock that is frozen or compacted until its bonds break.
struct CrustCase {
  double tensile_strength_Pa = 0;  ///< of the bonds; 0: no crust
  double shear_ratio = 1;          ///< shear strength by tensile strength
  double above_m = 0;              ///< height in W from which rock is bonded
  double thickness_m = 0;          ///< straight down from the pile's surface; 0: no limit
};

/// collapse: rock over the bench that comes down during the dig (coupler/deck/collapse.hpp).
struct CollapseCase {
  double height_m = 0;  ///< of the slab, straight up; 0: none
  double at_s = 0;      ///< when it comes loose; 0: when the door first opens
};

/// How the settled bench is made: poured as a whole, or laid from a block that was poured once
/// (coupler/deck/brick.hpp).
enum class PileBuilt { poured, bricks };

/// pile: a bench of rock that fills x > toe, between side walls: a trapezoid, or a scanned profile.
struct PileCase {
  double toe_x_m = 0;         ///< where the settled face should meet the ground, in W
  double height_m = 0;        ///< of the bench behind the crest
  double width_m = 0;         ///< along y, centred on y = 0, between frictionless planes
  double crest_depth_m = 0;   ///< flat top between the crest and the rear wall
  double face_angle_deg = 0;  ///< of the retaining sheet while the rock settles
  PileBuilt built = PileBuilt::poured;
  double settle_s = 0;  ///< with the sheet; of a brick
  double relax_s = 0;   ///< after the sheet is gone; of a bench of bricks
  /// A scanned section, CSV (coupler/case/outline_file.hpp), or surface, STL
  /// (coupler/case/bench_surface.hpp), in place of toe, height, crest depth and face angle; empty:
  /// none.
  std::filesystem::path profile;
  std::vector<Eigen::Vector2d> outline_m;  ///< the profile's points: x and z in W
  /// The surface when the profile is an STL; the outline then is its highest section.
  std::shared_ptr<const BenchSurface> surface;
  /// rock this near to ground, rear and side walls is held fixed; 0: none
  double held_layer_m = 0;
  bool clear_machine = false;  ///< rock that overlaps dipper, door or truck at the start is removed
  /// Rock on the floor in front of this x is removed when the dipper is back; 0: it stays.
  double clean_floor_to_x_m = 0;
};

/// truck: a fixed wall. Rock inside its bed is counted.
struct TruckCase {
  std::filesystem::path mesh;
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();  ///< origin of the truck mesh, in W
  double heading_deg = 0;                                ///< about z
  double rated_t = 0;  ///< payload that it is to leave with; 0: not given
};

/// site: where W lies in the mine's coordinates (analysis/survey). By default they are W's.
struct SiteCase {
  Eigen::Vector3d origin_m =
      Eigen::Vector3d::Zero();  ///< easting, northing, elevation of W's origin
  double azimuth_deg = 90;      ///< of W's x, clockwise from grid north
};

/// The loop over the rock's time steps: this program's faster one (dem/fast), or LIGGGHTS's own.
enum class RockLoop { fast, liggghts };

/// dem
struct DemCase {
  RockLoop loop = RockLoop::fast;
  double timestep_s = 0;
  int ranks = 1;
  double hold_below_m_s = 0;  ///< rock slower than this may be held (dem/hold.hpp); 0: none
};

/// coupling
struct CouplingCase {
  core::Scheme scheme = core::Scheme::corrected;
  int sync_steps = 0;    ///< DEM steps a window
  double timeout_s = 0;  ///< a side without a reply for this long has failed
};

/// output
struct OutputCase {
  double dump_every_s = 0;
  double checkpoint_every_s = 0;  ///< simulated time; 0: only when interrupted
  bool wall_stress = false;       ///< pressure on the bodies' triangles
  double wear_m3_J = 0;           ///< Finnie's coefficient; 0: no wear
};

/// observation: the mine's instruments (analysis/signals/observe.hpp).
struct ObservationCase {
  double rate_Hz = 1;     ///< of the drives' logger; a sample is the mean over its interval
  double lag_s = 0;       ///< delay of the logged forces against the motion
  double scale_gain = 0;  ///< the truck scale reads 1 + this times the mass
  double truck_spillage =
      0;  ///< part of the last pass that falls off the truck before it is weighed
  double scale_offset_t = 0;   ///< added to the truck scale's reading of each pass
  double hoist_cell_gain = 0;  ///< the hoist's force reads 1 + this times its value
  double crowd_cell_gain = 0;  ///< likewise the crowd's
  double door_leak = 0;        ///< share of each load that is lost before the dump
  /// Force that the drives show besides: {term: number}, analysis/signals/drive_terms.hpp.
  std::map<std::string, double> hoist_law, crowd_law;
};

/// The whole case, as it will run (after --set).
struct Case {
  std::filesystem::path folder;
  int format = 0;    ///< of case.yaml; this program reads format 1
  std::string name;  ///< the folder's name
  std::string title;
  std::int64_t seed = 0;
  double end_s = 0;  ///< simulated time; 0: until the motion is done
  MachineCase machine;
  OperatorCase op;
  RockCase rock;
  ContactCase contact;
  CrustCase crust;
  PileCase pile;
  CollapseCase collapse;
  std::map<std::string, std::filesystem::path>
      bodies;  ///< body name -> wall mesh, in its own frame
  TruckCase truck;
  SiteCase site;
  /// The DEM box, in W. Rock that leaves it is lost; a wall that leaves it is an error.
  Box domain{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  DemCase dem;
  CouplingCase coupling;
  OutputCase output;
  ObservationCase observation;
  /// Effect -> strength (effects.hpp). The values above include them; `text` has only the values.
  std::map<std::string, double> effects;
  std::string text;  ///< canonical text of all of the above: sorted lines that --set accepts
  std::map<std::string, Origin> origins;  ///< dotted key -> where it was set; for later findings
};

/// A finding at the line that set `key`, or the nearest section above it.
Finding finding_at(const Case& c, const std::string& key, const std::string& message);

/// Findings about the file that `key` names: at its own lines, or, when a fault has no line, where
/// the case names it.
void add_file_findings(const Case& c, const std::string& key, const InputError& error,
                       std::vector<Finding>& findings);

/// A "key=value" from --set; keys are dotted paths as in "rock.density_kg_m3".
struct Override {
  std::string key;
  std::string value;
};

/// Reads CASE/case.yaml and applies the overrides. Every syntax, key, type, unit and range error is
/// appended to `findings`; the case is usable only when none was.
Case load_case(const std::filesystem::path& folder, const std::vector<Override>& overrides,
               std::vector<Finding>& findings);

}  // namespace dipper::cases
