#include "common/mesh/tooth_wear.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

namespace dipper::mesh {
namespace {

constexpr double kLeast = 0.1;      // of an edge that is left: facets must not become slivers
constexpr double kInPlane = 0.999;  // cosine between normals of one plane; STL coordinates round

using Edge = std::pair<std::size_t, std::size_t>;  // vertex numbers, the lower one first

/// For each vertex, where the edges between two planes lead from it.
std::vector<std::vector<std::size_t>> creases(const TriangleMesh& mesh) {
  std::map<Edge, std::vector<Eigen::Vector3d>> normals;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Triangle t = mesh.corners(i);
    const Eigen::Vector3d n = (t[1] - t[0]).cross(t[2] - t[0]).normalized();
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t a = mesh.triangles[i][k], b = mesh.triangles[i][(k + 1) % 3];
      normals[std::minmax(a, b)].push_back(n);
    }
  }
  std::vector<std::vector<std::size_t>> out(mesh.vertices.size());
  for (const auto& [edge, n] : normals) {
    if (n.size() == 2 && n[0].dot(n[1]) > kInPlane) continue;
    out[edge.first].push_back(edge.second);
    out[edge.second].push_back(edge.first);
  }
  return out;
}

/// How far a tip may wear: to kLeast of the shortest edge that leads back from a foremost vertex.
double most(const TriangleMesh& mesh, const std::vector<std::vector<std::size_t>>& edges,
            double tip) {
  constexpr double kAtTip = 1e-3;  // m
  double length = 0;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (mesh.vertices[v].x() < tip - kAtTip) continue;
    double back = 0;
    for (const std::size_t w : edges[v]) back = std::max(back, tip - mesh.vertices[w].x());
    length = length == 0 ? back : std::min(length, back);
  }
  return (1 - kLeast) * length;
}

}  // namespace

TriangleMesh wear_teeth(const TriangleMesh& dipper, double wear) {
  const double tip = bounding_box(dipper).max_m.x(), cut = tip - wear;
  const auto edges = creases(dipper);
  const auto refuse = [&] {
    throw std::invalid_argument(
        fmt::format("teeth cannot wear by {:g} m; allowed for this mesh, whose teeth are single "
                    "wedges along x for that length, is > 0 and <= {:.3g}",
                    wear, most(dipper, edges, tip)));
  };
  if (!(wear > 0)) refuse();
  TriangleMesh worn = dipper;
  for (std::size_t v = 0; v < dipper.vertices.size(); ++v) {
    const Eigen::Vector3d& p = dipper.vertices[v];
    if (p.x() <= cut) continue;
    const Eigen::Vector3d* behind = nullptr;
    for (const std::size_t w : edges[v]) {
      const Eigen::Vector3d& q = dipper.vertices[w];
      if (q.x() >= cut) continue;
      if (behind != nullptr) refuse();
      behind = &q;
    }
    if (behind == nullptr) refuse();
    const double left = (cut - behind->x()) / (p.x() - behind->x());
    if (left < kLeast) refuse();
    worn.vertices[v] = *behind + left * (p - *behind);
  }
  return worn;
}

}  // namespace dipper::mesh
