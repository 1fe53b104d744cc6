#include "analysis/report/replay_json.hpp"

#include <algorithm>
#include <cmath>

namespace dipper::analysis::report {

using json = nlohmann::json;

double rounded(double x, double per_unit) { return std::round(x * per_unit) / per_unit; }

json json_of_triangles(const mesh::TriangleMesh& mesh) {
  json flat = json::array();
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    for (const auto& corner : mesh.corners(k)) {
      for (const double x : {corner.x(), corner.y(), corner.z()}) {
        flat.push_back(rounded(x, 1e3));
      }
    }
  }
  return flat;
}

json json_of_pose(const Pose& X) {
  json row = json::array();
  for (const double x : {X.p.x(), X.p.y(), X.p.z()}) row.push_back(rounded(x, 1e4));
  for (const double q : {X.R.w(), X.R.x(), X.R.y(), X.R.z()}) row.push_back(rounded(q, 1e5));
  return row;
}

json json_of_figure(const run::Figure& figure, const std::vector<double>& times_s) {
  json out = {{"bodies", json::array()}, {"ropes", json::array()}};
  for (const run::FigureBody& body : figure.bodies) {
    json parts = json::array(), poses = json::array();
    for (const machine::FigurePart& part : body.parts)
      parts.push_back({{"name", part.name}, {"triangles_m", json_of_triangles(part.mesh)}});
    for (const double t : times_s) poses.push_back(json_of_pose(body.X_WF(t)));
    if (std::all_of(poses.begin(), poses.end(), [&](const json& X) { return X == poses[0]; }))
      poses = json::array({poses[0]});
    out["bodies"].push_back(
        {{"name", body.name}, {"parts", std::move(parts)}, {"poses", std::move(poses)}});
  }
  for (const run::FigureRope& rope : figure.ropes) {
    json ways = json::array();
    for (const double t : times_s) {
      json way = json::array();
      for (const Vector3d& p : rope.way_W(t))
        for (const double x : {p.x(), p.y(), p.z()}) way.push_back(rounded(x, 1e3));
      ways.push_back(std::move(way));
    }
    out["ropes"].push_back({{"radius_m", rounded(rope.radius_m, 1e3)},
                            {"pass", rope.pass},
                            {"ways", std::move(ways)}});
  }
  return out;
}

}  // namespace dipper::analysis::report
