#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/rock/struck_volume.hpp"
#include "coupler/case/mesh_facts.hpp"
#include "coupler/check/warning_parts.hpp"

namespace dipper::check {
namespace {

constexpr double kMuch = 0.15;      // of a volume: a fill factor that is off by it misleads
constexpr double kOutside_m = 0.2;  // of a cavity beyond the mesh that holds it
constexpr double kCell = 1.0 / 40;  // of the mesh's longest side: half the error of kMuch

/// The dipper with its door as at the start of the motion: shut.
mesh::TriangleMesh vessel_of(const CaseParts& parts) {
  mesh::TriangleMesh vessel = parts.dipper;
  const machine::ShovelPose pose = parts.shovel.pose(parts.motion.value(parts.motion.start_ns()));
  const Pose X_BD = inverse(pose.X_WB) * pose.X_WD;
  for (std::size_t t = 0; t < parts.door.triangles.size(); ++t) {
    mesh::Triangle corners = parts.door.corners(t);
    for (auto& c : corners) c = X_BD * c;
    vessel.add_loose(corners);
  }
  return vessel;
}

}  // namespace

void warn_of_cavity(const cases::Case& c, const std::string& body, const Box& mesh,
                    const Box& cavity, std::vector<Finding>& warnings) {
  const double out_m =
      std::max((mesh.min_m - cavity.min_m).maxCoeff(), (cavity.max_m - mesh.max_m).maxCoeff());
  if (out_m > kOutside_m)
    warnings.push_back(cases::finding_at(
        c, "bodies." + body,
        fmt::format("the cavity in its YAML extends {:.1f} m beyond the mesh: rock beside the {} "
                    "would count as payload",
                    out_m, body)));
}

void warn_of_volume(const CaseParts& parts, std::vector<Finding>& warnings) {
  std::vector<Finding> unread;
  const cases::DipperFacts facts = cases::read_dipper_facts(parts.c, unread);
  if (!unread.empty()) return;
  const mesh::TriangleMesh vessel = vessel_of(parts);
  const Box box = mesh::bounding_box(vessel);
  const double longest_m = box.sides_m().maxCoeff();
  const double held_m3 = analysis::rock::struck_volume(vessel, {kCell * longest_m}).volume_m3;
  const double given_m3 = facts.struck_volume_m3;
  const auto say = [&](const std::string& what) {
    warnings.push_back(cases::finding_at(parts.c, "bodies.dipper", what));
  };
  if (held_m3 < kMuch * given_m3)
    say(fmt::format(
        "with the door shut the mesh holds {:.1f} m3, but its YAML says struck_volume_m3: {:g}; is "
        "there a gap, or is the door open at the start?",
        held_m3, given_m3));
  else if (std::abs(held_m3 - given_m3) > kMuch * given_m3)
    say(fmt::format(
        "the mesh holds {:.1f} m3, struck, but its YAML says struck_volume_m3: {:g}, which "
        "the fill factor uses",
        held_m3, given_m3));
  const double of_machine_m3 = parts.machine.dipper.struck_volume;
  if (std::abs(of_machine_m3 - given_m3) > kMuch * given_m3)
    warnings.push_back({parts.c.machine.model, 0, "dipper.struck_volume",
                        fmt::format("is {:g} m3, but the YAML of the dipper's mesh says {:g}",
                                    of_machine_m3, given_m3)});
  const Vector3d inside_m = parts.machine.dipper.inside, cavity_m = facts.cavity.sides_m();
  if (((inside_m - cavity_m).array().abs() > kMuch * cavity_m.array()).any())
    warnings.push_back(
        {parts.c.machine.model, 0, "dipper.inside",
         fmt::format("is {:g} x {:g} x {:g} m, but the cavity in the YAML of the dipper's mesh is "
                     "{:g} x {:g} x {:g} m; the sweep of the teeth and planned digs use the former",
                     inside_m.x(), inside_m.y(), inside_m.z(), cavity_m.x(), cavity_m.y(),
                     cavity_m.z())});
  warn_of_cavity(parts.c, "dipper", box, facts.cavity, warnings);
}

}  // namespace dipper::check
