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
  const std::vector<std::string> weighed = cases::weighed_bodies(c);
  for (const auto& [body, file] : c.bodies) {
    const Rows& rows = table.rows(body);
    if (rows.size() > 1 && never_moves(rows))
      warnings.push_back(
          {c.machine.poses, rows.front().line, "machine.poses",
           fmt::format("{} never moves: all its {} rows are alike", body, rows.size())});
    const mesh::TriangleMesh mesh = mesh::read_stl(file);
    warn_of_the_ground(c, body, rows, mesh, warnings);
    if (std::find(weighed.begin(), weighed.end(), body) == weighed.end()) continue;
    std::vector<Finding> unread;
    const Box cavity = cases::read_dipper_facts(c, unread, body).cavity;
    if (unread.empty()) warn_of_cavity(c, body, mesh::bounding_box(mesh), cavity, warnings);
  }
}

}  // namespace dipper::check
