#include "coupler/deck/deck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include "common/angles.hpp"
#include "common/mesh/stl.hpp"
#include "common/text_file.hpp"
#include "coupler/case/bench_surface.hpp"
#include "coupler/case/machine_kind.hpp"
#include "coupler/case/outline_file.hpp"
#include "coupler/deck/contact_table.hpp"
#include "coupler/deck/domain_split.hpp"
#include "coupler/deck/pile_shape.hpp"
#include "coupler/deck/pile_walls.hpp"
#include "coupler/deck/rock_kinds.hpp"
#include "coupler/deck/shape_library.hpp"
#include "machine/teeth_path.hpp"

namespace dipper::deck {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSurfaceFile = "surface.stl";

/// LIGGGHTS wants primes above 10,000; a different one for each stream k of a case.
std::int64_t prime_seed(std::int64_t seed, int k) {
  constexpr std::int64_t kSpan = 800'000;
  const std::int64_t mixed = (seed * 104'729 + std::int64_t{k} * 7'919) % kSpan;
  std::int64_t n = 10'007 + (mixed < 0 ? mixed + kSpan : mixed);
  const auto prime = [](std::int64_t m) {
    for (std::int64_t d = 2; d * d <= m; ++d)
      if (m % d == 0) return false;
    return true;
  };
  while (!prime(n)) ++n;
  return n;
}

std::string wall_arrays(const cases::OutputCase& o) {
  return std::string("\"id") + (o.wall_stress ? " stress" : "") + (o.wear_m3_J > 0 ? " wear" : "") +
         "\"";
}

/// Lists are kept until something has moved by half of this; the dipper does so every few
/// steps. Two fifths of the smallest rock cost least (docs/benchmarks.md).
double skin_m(const cases::RockCase& rock) {
  double smallest = rock.classes.front().size_m;
  for (const cases::SizeClass& s : rock.classes) smallest = std::min(smallest, s.size_m);
  return 0.4 * grained_size_m(rock, smallest);
}

std::vector<std::pair<std::string, fs::path>> wall_meshes(const cases::Case& c) {
  std::vector<std::pair<std::string, fs::path>> walls(c.bodies.begin(), c.bodies.end());
  if (cases::has_truck(c)) walls.emplace_back("truck", c.truck.mesh);
  return walls;
}

/// Scripts cannot name every file (LIGGGHTS splits words at blanks): a mesh with an absolute path
/// is copied into the deck.
std::string mesh_in_deck(const std::string& name, const fs::path& mesh) {
  return mesh.is_absolute() ? "${deck}/walls/" + name + ".stl" : mesh.generic_string();
}

std::string case_in(const cases::Case& c) {
  const PileShape pile = pile_shape(c);
  const AtomTypes types = atom_types(c);
  std::string out = "# Written by dipper from the case: what dem_in/*.in needs of it.\n";
  const auto var = [&](const std::string& name, double v, const char* note) {
    out += fmt::format("variable {:<16} index {:.9g}   # {}\n", name, v, note);
  };
  const auto text = [&](const std::string& name, const std::string& v, const char* note) {
    out += fmt::format("variable {:<16} index {}   # {}\n", name, v, note);
  };
  var("timestep", c.dem.timestep_s, "s");
  var("skin", skin_m(c.rock), "m; of the dig's neighbour lists");
  const DomainSplit split = best_split(c, c.dem.ranks);
  text("split_x", std::to_string(split.parts[0]),
       "parts of the box along x and z; y takes the rest");
  text("split_z", std::to_string(split.parts[2]), "");
  var("rock_density", laden_density(c), "kg/m3, of a rock, with the fines that move with it");
  const std::array<const char*, 3> axis = {"x", "y", "z"};
  for (int i = 0; i < 3; ++i) {
    var(fmt::format("{}lo", axis[static_cast<std::size_t>(i)]), c.domain.min_m[i], "m, box");
    var(fmt::format("{}hi", axis[static_cast<std::size_t>(i)]), c.domain.max_m[i], "m");
  }
  text("types", std::to_string(types.count()), "size classes, then the walls:");
  text("dipper_type", std::to_string(types.dipper()), "");
  text("ground_type", std::to_string(types.ground()), "");
  text("truck_type", std::to_string(types.truck()), "");
  text("sides_type", std::to_string(types.sides()), "frictionless");
  text("cohesion", needs_cohesion_model(c) ? "moist" : "off",
       "model; moist is in dipper-liggghts only");
  var("bond_tension", c.crust.tensile_strength_Pa, "Pa, of a crust");
  var("bond_shear", c.crust.shear_ratio * c.crust.tensile_strength_Pa, "Pa");
  text("wear", c.output.wear_m3_J > 0 ? "finnie" : "off", "of dipper and door");
  text("wall_arrays", wall_arrays(c.output), "in their dumps");
  var("toe", pile.toe_x_m, "m, x of the bench's toe");
  var("rear", pile.rear_x_m, "m, x of the wall behind it");
  if (c.pile.surface) text("outline", kSurfaceFile, "what the bench is cut to");
  var("half_width", c.pile.width_m / 2, "m");
  var("pour_height", pile.pour_height_m, "m");
  var("pour_run", pile.pour_run_m, "m, x from the toe to the pour's crest");
  var("pour_mass", pile.mass_kg, "kg");
  var("settle_time", c.pile.settle_s, "s, with the sheet");
  var("relax_time", c.pile.relax_s, "s, without");
  text("pour_seed", std::to_string(prime_seed(c.seed, 0)), "");
  for (const auto& [name, mesh] : wall_meshes(c))
    text(name + "_mesh", mesh_in_deck(name, mesh), "");
  if (!cases::has_truck(c)) return out;
  for (int i = 0; i < 3; ++i)
    var(fmt::format("truck_{}", axis[static_cast<std::size_t>(i)]), c.truck.position_m[i], "m");
  var("truck_heading", c.truck.heading_deg, "deg, about z");
  return out;
}

std::string walls_in(const cases::Case& c) {
  std::string meshes, n = std::to_string(c.bodies.size() + 1);
  std::string out =
      "# Written by dipper from the case: the walls of the dig that have meshes.\n"
      "# Forces are on the mesh, torques about the reference point, which moves with the mesh: "
      "the\n"
      "# origin of the body's own frame when its _x, _y, _z are 0, as dipper-dem sets them.\n"
      "# curvature_tolerant: thin facets, as CAD programs make them, are allowed; `dipper check`\n"
      "# refuses those that are too thin for LIGGGHTS.\n"
      "fix sides all mesh/surface file ${deck}/sides.stl type ${sides_type}\n";
  if (cases::has_truck(c)) {
    out +=
        "fix truck all mesh/surface file ${truck_mesh} type ${truck_type} &\n"
        "  rotate axis 0.0 0.0 1.0 angle ${truck_heading} move ${truck_x} ${truck_y} ${truck_z} &\n"
        "  curvature_tolerant yes\n";
    meshes = " truck";
    n = std::to_string(c.bodies.size() + 2);
  }
  meshes += " sides";
  for (const auto& body : c.bodies) {
    const std::string& name = body.first;
    for (const char* axis : {"x", "y", "z"})
      out += fmt::format("variable {}_{} index 0.0\n", name, axis);
    out += fmt::format(
        "fix {0} all mesh/surface/stress file ${{{0}_mesh}} type ${{dipper_type}} &\n"
        "  move ${{{0}_x}} ${{{0}_y}} ${{{0}_z}} curvature_tolerant yes &\n"
        "  reference_point 0.0 0.0 0.0 wear ${{wear}}\n",
        name);
    meshes += " " + name;
  }
  out +=
      "fix walls all wall/gran model hooke/stiffness tangential history cohesion ${cohesion} &\n"
      "  rolling_friction epsd2 mesh n_meshes " +
      n + " meshes" + meshes + " limitForce on\n";
  out += "variable first_body index " + c.bodies.begin()->first + "   # whose force the log has\n";
  for (const auto& body : c.bodies)
    out += fmt::format(
        "dump {0} all mesh/vtk ${{dump_steps}} ${{out}}/{0}_*.vtk ${{wall_arrays}} {0}\n",
        body.first);
  if (cases::has_truck(c))
    out += "dump truck all mesh/vtk ${dump_steps} ${out}/truck_*.vtk id truck\n";
  return out;
}

std::string table(const std::string& name, const std::string& comment, const Eigen::MatrixXd& m) {
  std::string out = fmt::format("\n# {}\nfix {} all property/global {} peratomtypepair {}", comment,
                                name, name, m.rows());
  for (Eigen::Index i = 0; i < m.rows(); ++i) {
    out += " &\n ";
    for (Eigen::Index j = 0; j < m.cols(); ++j) out += fmt::format(" {:>11.5e}", m(i, j));
  }
  return out + "\n";
}

std::string material_in(const cases::Case& c) {
  const ContactTable t = contact_table(c);
  std::string out =
      "# Written by dipper from the case. Svanberg et al. 2021, Eqs. 3-8 and Table 2, as\n"
      "# coupler/deck/contact_table.hpp maps them. Row and column are atom types:\n#";
  int type = 0;
  for (const cases::SizeClass& s : c.rock.classes) out += fmt::format(" {} {},", ++type, s.name);
  out += fmt::format(" {} dipper, {} ground, {} truck, {} sides.\n", type + 1, type + 2, type + 3,
                     type + 4);
  out += table("kn", "K_n [N/m], Eqs. 4, 5", t.kn);
  out += table("kt", "K_t = C_tan K_n [N/m]", t.kt);
  out += table("gamman", "c_n/m [1/s], Eq. 6: 2 D_n sqrt(K_n/m)", t.gamman);
  out += table("gammat", "c_t/m [1/s], Eq. 6: 2 D_t sqrt(K_t/m)", t.gammat);
  out += table("coefficientFriction", "mu, Eq. 7", t.friction);
  out += table("coefficientRollingFriction", "mu', Eq. 8", t.rolling);
  if (needs_cohesion_model(c)) {
    out += table("moistPullOff", "F/d^2 [Pa], dem/moist/moist_law.hpp", t.pull_off_Pa);
    out +=
        "\n# A crust: strengths [Pa], and where it forms\n"
        "fix bondTensileStrength all property/global bondTensileStrength scalar ${bond_tension}\n"
        "fix bondShearStrength all property/global bondShearStrength scalar ${bond_shear}\n"
        "fix crust_zone all property/atom crust_zone scalar no yes no 0.0\n";
  }
  if (c.output.wear_m3_J > 0) {
    const Eigen::MatrixXd k =
        Eigen::MatrixXd::Constant(t.kn.rows(), t.kn.cols(), c.output.wear_m3_J);
    out += table("k_finnie", "Finnie's coefficient [m3/J]", k);
  }
  return out;
}

struct Template {
  std::string fix;
  double mass_fraction;
};

std::string rocks_in(const cases::Case& c, const std::map<std::string, RockShape>& shapes) {
  const std::vector<RockClass> classes = rock_classes(c);
  const double rho = laden_density(c);
  std::string out =
      "# Written by dipper from the case: one template a class and shape. Mass and inertia are "
      "the\n"
      "# mesh's (use_density keeps them, and keeps LIGGGHTS from moving the centre of mass).\n"
      "group spheres type 1\n";
  std::vector<Template> templates;
  int shape_type = 0;
  for (std::size_t i = 0; i < classes.size(); ++i) {
    const cases::SizeClass& s = c.rock.classes[i];
    const double size = 2 * classes[i].radius_m;
    for (const std::string& shape : s.shapes) {
      const std::string fix = kind_name(s, shape);
      const auto seed = prime_seed(c.seed, 1 + static_cast<int>(templates.size()));
      templates.push_back({fix, s.mass_percent / 100 / static_cast<double>(s.shapes.size())});
      if (classes[i].is_sphere) {
        out += fmt::format(
            "\nfix {} spheres particletemplate/sphere {} atom_type {} density constant {:.9g} &\n"
            "  radius constant {:.9g}\n",
            fix, seed, i + 1, rho, classes[i].radius_m);
        continue;
      }
      const RockShape& rock = shapes.at(shape);
      const Eigen::Matrix3d J = rho * std::pow(size, 5) * rock.mass.inertia_m5;
      out += fmt::format(
          "\nfix {} all particletemplate/multisphere {} atom_type {} density constant {:.9g} &\n"
          "  nspheres {} ntry 200000 spheres file ${{deck}}/{}.spheres scale {:.9g} &\n"
          "  type {} mass {:.9g} use_density &\n"
          "  inertia_tensor {:.9g} {:.9g} {:.9g} {:.9g} {:.9g} {:.9g}\n",
          fix, seed, i + 1, rho, rock.fit(c.rock.shape_resolution).spheres.size(), shape, size,
          ++shape_type, classes[i].mass_kg, J(0, 0), J(0, 1), J(0, 2), J(1, 1), J(1, 2), J(2, 2));
    }
  }
  out += fmt::format("\nfix grading all particledistribution/discrete/massbased {} {}",
                     prime_seed(c.seed, 1 + static_cast<int>(templates.size())), templates.size());
  for (const Template& t : templates) out += fmt::format(" &\n  {} {:.9g}", t.fix, t.mass_fraction);
  return out + "\n";
}

std::string sphere_file(const RockShape& shape, const std::string& resolution) {
  std::string out = fmt::format("# {}: x y z radius, volume-equivalent diameter 1\n", shape.name);
  for (const Sphere& s : shape.fit(resolution).spheres)
    out += fmt::format("{:.6f} {:.6f} {:.6f} {:.6f}\n", s.centre_m.x(), s.centre_m.y(),
                       s.centre_m.z(), s.radius_m);
  return out;
}

}  // namespace

PileShape pile_shape(const cases::Case& c) {
  const cases::PileCase& p = c.pile;
  PileShape s;
  if (p.profile.empty()) {
    s.toe_x_m = p.toe_x_m;
    s.height_m = p.height_m;
    s.pour_run_m = p.height_m / std::tan(radians(p.face_angle_deg));
    s.rear_x_m = s.toe_x_m + s.pour_run_m + p.crest_depth_m;
    s.volume_m3 = p.width_m * p.height_m * (s.pour_run_m / 2 + p.crest_depth_m);
  } else {
    s.toe_x_m = p.outline_m.front().x();
    s.rear_x_m = p.outline_m.back().x();
    for (const auto& point : p.outline_m) s.height_m = std::max(s.height_m, point.y());
    s.volume_m3 = p.width_m * s.height_m * (s.rear_x_m - s.toe_x_m);
  }
  s.mass_kg = kPourExcess * kSettledFraction * laden_density(c) * s.volume_m3;
  s.pour_height_m = s.height_m * kPourExcess * kSettledFraction / kPouredFraction;
  return s;
}

cases::BenchOutline bench_outline(const cases::Case& c) {
  if (!c.pile.profile.empty()) return c.pile.outline_m;
  const PileShape s = pile_shape(c);
  return {{s.toe_x_m, 0}, {s.toe_x_m + s.pour_run_m, s.height_m}, {s.rear_x_m, s.height_m}};
}

cases::BenchOutline bench_along_boom(const cases::Case& c, double heading_rad) {
  constexpr double kAhead = 0.1;  // cosine: a boom that points further away does not meet the bench
  cases::BenchOutline section = {{0, 0}};
  if (std::cos(heading_rad) < kAhead) {
    section.emplace_back(c.domain.max_m.x() - c.machine.base_position_m.x(), 0);
    return section;
  }
  cases::BenchOutline bench;
  for (const Eigen::Vector2d& p : bench_outline(c))
    bench.emplace_back((p.x() - c.machine.base_position_m.x()) / std::cos(heading_rad), p.y());
  // The side walls, where the boom's plane crosses them.
  const double y = c.machine.base_position_m.y(), slope = std::sin(heading_rad);
  const double half = c.pile.width_m / 2;
  double from = bench.front().x(), to = bench.back().x();
  if (slope != 0) {
    from = std::max(from, std::min((-half - y) / slope, (half - y) / slope));
    to = std::min(to, std::max((-half - y) / slope, (half - y) / slope));
  } else if (std::abs(y) > half) {
    to = from;
  }
  if (from >= to) return section;
  if (from > bench.front().x())
    section.insert(section.end(), {{from, 0}, {from, machine::height(bench, from)}});
  for (const Eigen::Vector2d& p : bench)
    if (p.x() >= from && p.x() <= to) section.push_back(p);
  if (to < bench.back().x())
    section.insert(section.end(), {{to, machine::height(bench, to)}, {to, 0}});
  return section;
}

std::vector<ClassCount> rock_counts(const cases::Case& c) {
  const std::vector<RockClass> classes = rock_classes(c);
  const double mass = pile_shape(c).mass_kg;
  std::vector<ClassCount> out;
  for (std::size_t i = 0; i < classes.size(); ++i)
    out.push_back(
        {c.rock.classes[i].name, mass * c.rock.classes[i].mass_percent / 100 / classes[i].mass_kg});
  return out;
}

std::map<std::string, RockShape> used_shapes(const cases::Case& c, const fs::path& folder) {
  std::map<std::string, RockShape> used;
  for (const cases::SizeClass& s : c.rock.classes)
    for (const std::string& name : s.shapes)
      if (name != "sphere" && used.count(name) == 0) used[name] = find_rock_shape(folder, name);
  return used;
}

void write_rock(const cases::Case& c, const std::map<std::string, RockShape>& shapes,
                const fs::path& folder) {
  write_text(folder / "material.in", material_in(c));
  write_text(folder / "rocks.in", rocks_in(c, shapes));
  for (const auto& [name, shape] : shapes)
    write_text(folder / (name + ".spheres"), sphere_file(shape, c.rock.shape_resolution));
}

void write_deck(const cases::Case& c, const fs::path& shapes, const fs::path& folder) {
  for (const ClassCount& k : rock_counts(c))
    if (k.rocks < 1)
      throw std::invalid_argument(
          fmt::format("rock.classes: {}: the pile holds {:.2f} rocks of this class; make the pile "
                      "larger or the class smaller",
                      k.name, k.rocks));

  fs::create_directories(folder);
  write_text(folder / "case.in", case_in(c));
  write_text(folder / "walls.in", walls_in(c));
  write_rock(c, used_shapes(c, shapes), folder);
  if (c.pile.surface) {
    write_text(folder / kSurfaceFile, mesh::to_stl("surface", c.pile.surface->mesh()));
  } else {
    write_text(folder / "outline.csv", cases::to_csv(bench_outline(c)));
  }
  write_text(folder / "funnel.stl", mesh::to_stl("funnel", funnel_walls(c)));
  write_text(folder / "sides.stl", mesh::to_stl("sides", bench_walls(c)));
  for (const auto& [name, mesh] : wall_meshes(c)) {
    if (!mesh.is_absolute()) continue;
    fs::create_directories(folder / "walls");
    const fs::path copy = folder / "walls" / (name + ".stl");
    if (mesh::is_plain_stl(mesh)) {
      copy_contents(mesh, copy);
    } else {
      write_text(copy, mesh::to_stl(name, mesh::read_stl(mesh)));
    }
  }
}

}  // namespace dipper::deck
