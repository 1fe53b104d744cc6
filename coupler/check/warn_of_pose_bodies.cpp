#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "common/mesh/stl.hpp"
#include "common/seconds.hpp"
#include "coupler/case/mesh_facts.hpp"
#include "coupler/check/warning_parts.hpp"
#include "machine/pose_table.hpp"

namespace dipper::check {
namespace {

using Rows = std::vector<machine::PoseTable::Row>;

constexpr double kUnderGround = 0.1;  // of a body's height
constexpr double kStill_m = 1e-3;     // and as much of a quaternion
constexpr double kCavityOut_m = 0.2;  // of a cavity beyond the mesh that holds it

bool never_moves(const Rows& rows) {
  const Pose& first = rows.front().X_WB;
  return std::all_of(rows.begin(), rows.end(), [&](const auto& row) {
    return (row.X_WB.p - first.p).norm() < kStill_m &&
           first.R.angularDistance(row.X_WB.R) < kStill_m;
  });
}

void warn_of_the_ground(const cases::Case& c, const std::string& body, const Rows& rows,
                        const mesh::TriangleMesh& mesh, std::vector<Finding>& warnings) {
  const double height = mesh::bounding_box(mesh).sides_m().z();
  double deepest = kUnderGround * height;
  const machine::PoseTable::Row* at = nullptr;
  for (const auto& row : rows) {
    double lowest = 0;
    for (const Vector3d& v : mesh.vertices) lowest = std::min(lowest, (row.X_WB * v).z());
    if (-lowest > deepest) deepest = -lowest, at = &row;
  }
  if (at == nullptr) return;
  warnings.push_back({c.machine.poses, at->line, "machine.poses",
                      fmt::format("{} goes {:.2g} m under the ground at {:g} s: is z over the "
                                  "ground, and the mesh in the body's own frame?",
                                  body, deepest, seconds(at->t_ns))});
}

}  // namespace

void warn_of_pose_bodies(const cases::Case& c, std::vector<Finding>& warnings) {
  const machine::PoseTable table = machine::PoseTable::load(c.machine.poses);
  for (const auto& [body, file] : c.bodies) {
    const Rows& rows = table.rows(body);
    if (rows.size() > 1 && never_moves(rows))
      warnings.push_back(
          {c.machine.poses, rows.front().line, "machine.poses",
           fmt::format("{} never moves: all its {} rows are alike", body, rows.size())});
    warn_of_the_ground(c, body, rows, mesh::read_stl(file), warnings);
  }
  for (const std::string& name : cases::weighed_bodies(c)) {
    std::vector<Finding> unread;
    const Box cavity = cases::read_dipper_facts(c, unread, name).cavity;
    const Box box = mesh::bounding_box(mesh::read_stl(c.bodies.at(name)));
    if (!unread.empty()) continue;
    const double out_m =
        std::max((box.min_m - cavity.min_m).maxCoeff(), (cavity.max_m - box.max_m).maxCoeff());
    if (out_m > kCavityOut_m)
      warnings.push_back(cases::finding_at(
          c, "bodies." + name,
          fmt::format("the cavity in its YAML extends {:.1f} m beyond the mesh: rock beside {} "
                      "would count as payload",
                      out_m, name)));
  }
}

}  // namespace dipper::check
