#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "common/angles.hpp"
#include "common/input_error.hpp"
#include "common/mesh/mesh_check.hpp"
#include "common/mesh/stl.hpp"
#include "common/mesh/tooth_wear.hpp"
#include "coupler/case/bench_surface.hpp"
#include "coupler/case/mesh_facts.hpp"
#include "coupler/case/outline_file.hpp"
#include "coupler/check/check_parts.hpp"
#include "coupler/deck/liggghts_path.hpp"
#include "coupler/deck/pile_shape.hpp"

namespace fs = std::filesystem;

namespace dipper::check {
namespace {

// LIGGGHTS's own limit of a facet's angles (surface_mesh_I.h, minAngle_hardLimit_), and a little.
const double kThinnestFacet = 1.01 * std::acos(0.9999995);

constexpr double kLeast_mm = 1000;  // of a mesh's longest side: a shorter one is no body's
constexpr double kPile_mm = 100;    // times the domain: a face that was not cropped is shorter

constexpr std::size_t faults_shown = 10;  // per file: the first few show what is wrong with it

// "reaches y = 28.3 m, 0.3 m beyond the domain's 28", once a side of the box that is passed.
void check_box(const cases::Case& c, const std::string& key, const std::string& what,
               const Box& box, Findings& findings) {
  for (int i = 0; i < 3; ++i) {
    const auto report = [&](double reached, double limit, const char* corner) {
      findings.push_back(cases::finding_at(
          c, key,
          fmt::format("{} reaches {} = {:.4g} m, {:.3g} m outside {} ({:g} m)", what, "xyz"[i],
                      reached, std::abs(reached - limit), corner, limit)));
    };
    if (box.min_m[i] < c.domain.min_m[i]) report(box.min_m[i], c.domain.min_m[i], "domain.min_m");
    if (box.max_m[i] > c.domain.max_m[i]) report(box.max_m[i], c.domain.max_m[i], "domain.max_m");
  }
}

// The first point of the profile beyond each side of the box.
void check_profile_points(const cases::Case& c, Findings& findings) {
  std::vector<int> lines;
  const cases::BenchOutline points = cases::read_outline(c.pile.profile, &lines);
  std::set<std::string> seen_corners;
  for (std::size_t k = 0; k < points.size(); ++k)
    for (const int i : {0, 1}) {
      const double at = points[k][i];
      const int axis = i == 0 ? 0 : 2;
      const double low = c.domain.min_m[axis], high = c.domain.max_m[axis];
      if (at >= low && at <= high) continue;
      const std::string corner = at < low ? "domain.min_m" : "domain.max_m";
      if (!seen_corners.insert(corner + "xz"[i]).second) continue;
      findings.push_back({c.pile.profile, lines[k], "pile.profile",
                          fmt::format("{}_m is {:g}, outside {} ({:g}); end the profile there or "
                                      "enlarge the domain",
                                      "xz"[i], at, corner, at < low ? low : high)});
    }
}

// Whether pile.profile is in another unit or place; then a finding says so, and others about its
// place would add nothing.
bool is_elsewhere(const cases::Case& c, Findings& findings) {
  Box box;
  if (c.pile.surface) box = mesh::bounding_box(c.pile.surface->mesh());
  for (std::size_t i = 0; !c.pile.surface && i < c.pile.outline_m.size(); ++i) {
    const auto& p = c.pile.outline_m[i];
    box.min_m = box.min_m.cwiseMin(Eigen::Vector3d(p.x(), 0, p.y()));
    box.max_m = box.max_m.cwiseMax(Eigen::Vector3d(p.x(), 0, p.y()));
  }
  const double longest = box.sides_m().maxCoeff();
  const double away = std::max(box.min_m.cwiseAbs().maxCoeff(), box.max_m.cwiseAbs().maxCoeff());
  const double domain = (c.domain.max_m - c.domain.min_m).maxCoeff();
  const auto say = [&](const std::string& what) {
    findings.push_back({c.pile.profile, 0, "pile.profile", what});
    return true;
  };
  const bool elsewhere = away > domain + longest || box.min_m.z() > c.domain.max_m.z();
  const bool fits_in_mm = longest > domain && 1e-3 * away <= domain;
  if (longest > kPile_mm * domain || (elsewhere && fits_in_mm))
    return say(
        fmt::format("is {:.4g} m long, and the whole domain {:.4g} m: in mm, perhaps? write "
                    "it in m",
                    longest, domain));
  if (elsewhere)
    return say(fmt::format(
        "lies at x = {:.8g} to {:.8g} m, z = {:.6g} to {:.6g} m: in the mine's coordinates, "
        "perhaps? It belongs into W, whose origin is the swing axis at ground level "
        "(docs/frames.md); dipper survey moves a point cloud there",
        box.min_m.x(), box.max_m.x(), box.min_m.z(), box.max_m.z()));
  return false;
}

}  // namespace

std::optional<mesh::TriangleMesh> load_sound_mesh(const cases::Case& c, const std::string& key,
                                                  const fs::path& file, Findings& findings) {
  if (!file_exists(c, key, file, findings)) return std::nullopt;
  if (!deck::liggghts_takes(file))
    findings.push_back(cases::finding_at(
        c, key,
        fmt::format("{}: {}; rename it or its folder", file.string(), deck::kLiggghtsRefuses)));
  try {
    mesh::TriangleMesh mesh = mesh::read_stl(file);
    auto faults = mesh::check_mesh(mesh);
    if (faults.empty()) faults = mesh::check_angles(mesh, kThinnestFacet);
    for (std::size_t i = 0; i < faults.size() && i < faults_shown; ++i) {
      findings.push_back({file, 0, key, faults[i].message});
    }
    if (faults.size() > faults_shown) {
      findings.push_back(
          {file, 0, key, fmt::format("and {} more faults", faults.size() - faults_shown)});
    }
    return mesh;
  } catch (const InputError& e) {
    cases::add_file_findings(c, key, e, findings);
    return std::nullopt;
  }
}

namespace {

constexpr double kHighestHeap = 2;    // by the cavity's depth
constexpr double kLeastCavity = 0.5;  // of the struck volume, which the cavity's box encloses
constexpr double kOtherBed = 3;       // a bed's side by the truck's

void check_cavity(const cases::Case& c, const std::string& name, Findings& findings) {
  const std::size_t before = findings.size();
  const cases::DipperFacts facts = cases::read_dipper_facts(c, findings, name);
  if (findings.size() > before) return;
  const auto say = [&](const std::string& key, const std::string& what) {
    findings.push_back({fs::path(c.bodies.at(name)).replace_extension(".yaml"), 0, key, what});
  };
  const Eigen::Vector3d sides = facts.cavity.sides_m();
  const double heap = facts.load.max_m.x() - facts.cavity.max_m.x();
  if (heap > kHighestHeap * sides.x())
    say("heap_height_m", fmt::format("{:g} m, over a cavity of {:g} m depth along x: in mm, "
                                     "perhaps? write both in m",
                                     heap, sides.x()));
  if (sides.prod() < kLeastCavity * facts.struck_volume_m3)
    say("cavity",
        fmt::format("is a box of {:.3g} m3, but struck_volume_m3 is {:g}: the cavity must "
                    "enclose what is struck",
                    sides.prod(), facts.struck_volume_m3));
}

}  // namespace

void check_bed(const cases::Case& c, const mesh::TriangleMesh& truck, Findings& findings) {
  std::vector<Finding> unread;
  const Box bed = cases::read_truck_bed(c, unread), box = mesh::bounding_box(truck);
  if (!unread.empty()) return;  // check_mesh_facts reports it
  const auto say = [&](const std::string& what) {
    findings.push_back({fs::path(c.truck.mesh).replace_extension(".yaml"), 0, "bed", what});
  };
  for (int i = 0; i < 3; ++i) {
    if (bed.max_m[i] < box.min_m[i] || bed.min_m[i] > box.max_m[i])
      return say(
          fmt::format("from {0} = {1:g} to {2:g} m, but the truck's mesh has {0} = {3:.4g} to "
                      "{4:.4g} m: write the bed in the mesh's frame, in m",
                      "xyz"[i], bed.min_m[i], bed.max_m[i], box.min_m[i], box.max_m[i]));
    const double side = bed.sides_m()[i], whole = box.sides_m()[i];
    if (i < 2 && (side > kOtherBed * whole || side < whole / (10 * kOtherBed)))
      return say(
          fmt::format("is {:.3g} m along {}, and the truck's mesh {:.3g} m: in another unit? "
                      "write it in m",
                      side, "xyz"[i], whole));
  }
}

// A missing mesh is reported by itself: its name is wrong, not the other's.
void check_mesh_facts(const cases::Case& c, Findings& findings) {
  for (const std::string& name : cases::weighed_bodies(c))
    if (fs::is_regular_file(c.bodies.at(name))) check_cavity(c, name, findings);
  if (fs::is_regular_file(c.truck.mesh)) cases::read_truck_bed(c, findings);
}

void check_tooth_wear(const cases::Case& c, const mesh::TriangleMesh& dipper, Findings& findings) {
  if (c.machine.tooth_wear_m == 0) return;
  try {
    mesh::wear_teeth(dipper, c.machine.tooth_wear_m);
  } catch (const std::invalid_argument& e) {
    findings.push_back(cases::finding_at(c, "machine.tooth_wear_m", e.what()));
  }
}

bool check_unit(const cases::Case& c, const std::string& key, const mesh::TriangleMesh& mesh,
                Findings& findings) {
  const Box box = mesh::bounding_box(mesh);
  const double longest = box.sides_m().maxCoeff();
  const double away = std::max(box.min_m.cwiseAbs().maxCoeff(), box.max_m.cwiseAbs().maxCoeff());
  const double domain = (c.domain.max_m - c.domain.min_m).maxCoeff();
  const auto say = [&](const std::string& what) {
    findings.push_back(cases::finding_at(c, key, what));
    return false;
  };
  if (longest > domain)
    return say(fmt::format(
        "the mesh is {:.4g} m long, and the whole domain {:.4g} m: in {}, perhaps? An STL file has "
        "no unit and is read in m; {:.4g} mm are {:.4g} m, scale it by 0.001 (cm: {:.4g} m, 0.01; "
        "inches: {:.4g} m, 0.0254)",
        longest, domain, longest > kLeast_mm ? "mm" : "cm or inches", longest, 1e-3 * longest,
        1e-2 * longest, 0.0254 * longest));
  if (away > domain + longest)
    return say(fmt::format(
        "the mesh lies up to {:.8g} m from its own origin, and is {:.4g} m long: in the mine's "
        "coordinates, perhaps? It belongs into its own frame (docs/frames.md): move it there",
        away, longest));
  return true;
}

mesh::TriangleMesh placed_truck(const cases::Case& c, mesh::TriangleMesh truck) {
  const Eigen::AngleAxisd turn(radians(c.truck.heading_deg), Eigen::Vector3d::UnitZ());
  for (Eigen::Vector3d& v : truck.vertices) v = c.truck.position_m + turn * v;
  return truck;
}

void check_truck_in_domain(const cases::Case& c, const mesh::TriangleMesh& truck,
                           Findings& findings) {
  check_box(c, "truck.position_m", "the truck", mesh::bounding_box(placed_truck(c, truck)),
            findings);
}

// The bench from the toe to its rear wall, and the rock above it before it falls; that of bricks
// falls elsewhere.
void check_pile_in_domain(const cases::Case& c, Findings& findings) {
  if (!c.pile.profile.empty() && is_elsewhere(c, findings)) return;
  const deck::PileShape shape = deck::pile_shape(c);
  const double half = c.pile.width_m / 2;
  Box box{{shape.toe_x_m, -half, 0}, {shape.rear_x_m, half, shape.height_m}};
  if (c.pile.surface) {
    for (const std::string& fault : c.pile.surface->faults(half))
      findings.push_back({c.pile.profile, 0, "pile.profile", fault});
  } else if (!c.pile.profile.empty()) {
    check_profile_points(c, findings);
    for (const int i : {0, 2}) {  // those checks report it
      box.min_m[i] = std::max(box.min_m[i], c.domain.min_m[i]);
      box.max_m[i] = std::min(box.max_m[i], c.domain.max_m[i]);
    }
  }
  check_box(c, c.pile.surface ? "pile.profile" : "pile", "the pile", box, findings);
  if (c.pile.built == cases::PileBuilt::bricks) return;
  const double top = shape.pour_height_m;
  if (shape.height_m <= c.domain.max_m.z() && top > c.domain.max_m.z()) {
    findings.push_back(cases::finding_at(
        c, "domain.max_m",
        fmt::format("z = {:g} is too low: the rock for this pile is poured up to z = {:.4g} m",
                    c.domain.max_m.z(), top)));
  }
}

}  // namespace dipper::check
