#include "common/mesh/mesh_check.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "common/angles.hpp"
#include "common/mesh/stl.hpp"

namespace dipper::mesh {
namespace {

using Edge = std::pair<std::size_t, std::size_t>;  // vertex numbers, the lower one first

struct EdgeUse {
  std::size_t facet;  // 0-based
  bool forward;       // from the lower vertex to the higher
};

std::string point(const Eigen::Vector3d& v) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", v.x(), v.y(), v.z());
}

// Whether a facet is lower than `least_height`: a line. Reading welds vertices at that distance.
bool is_degenerate(const TriangleMesh& mesh, std::size_t facet, double least_height) {
  const auto& t = mesh.triangles[facet];
  double longest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    longest = std::max(longest, (mesh.vertices[t[i]] - mesh.vertices[t[(i + 1) % 3]]).norm());
  }
  return 2 * facet_area(mesh, facet) <= least_height * longest;
}

class Checker {
 public:
  explicit Checker(const TriangleMesh& mesh)
      : mesh_(mesh),
        least_height_(weld_distance(bounding_box(mesh).sides_m().norm())),
        used_(mesh.triangles.size(), true) {}

  std::vector<MeshFault> run() {
    find_facet_faults();
    collect_edges();
    find_edge_faults();
    find_shell_faults();
    std::stable_sort(faults_.begin(), faults_.end(),
                     [](const MeshFault& a, const MeshFault& b) { return a.facet < b.facet; });
    return std::move(faults_);
  }

 private:
  using Kind = MeshFault::Kind;

  void add(Kind kind, std::size_t facet, const std::string& message) {
    faults_.push_back({kind, facet + 1, fmt::format("facet {}: {}", facet + 1, message)});
  }

  // Facets that are reported here are skipped where they would only cause more findings.
  void find_facet_faults() {
    std::map<std::array<std::size_t, 3>, std::size_t> seen;
    for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
      auto key = mesh_.triangles[i];
      std::sort(key.begin(), key.end());
      if (is_degenerate(mesh_, i, least_height_)) {
        add(Kind::degenerate, i,
            fmt::format("has no area, at {}; remove it", point(mesh_.vertices[key[0]])));
      }
      if (key[0] == key[1] || key[1] == key[2]) {
        used_[i] = false;  // its neighbours meet at its one real edge
      } else if (const auto [first, is_new] = seen.emplace(key, i); !is_new) {
        used_[i] = false;
        add(Kind::duplicate, i,
            fmt::format("has the corners of facet {}; remove one of them", first->second + 1));
      }
    }
  }

  void collect_edges() {
    for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
      if (!used_[i]) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t a = mesh_.triangles[i][k];
        const std::size_t b = mesh_.triangles[i][(k + 1) % 3];
        edges_[{std::min(a, b), std::max(a, b)}].push_back({i, a < b});
      }
    }
  }

  std::string ends(const Edge& edge) const {
    return fmt::format("the edge {} to {}", point(mesh_.vertices[edge.first]),
                       point(mesh_.vertices[edge.second]));
  }

  // An even number of facets above two is where two shells touch: sound.
  void find_edge_faults() {
    for (const auto& [edge, uses] : edges_) {
      if (uses.size() == 1) {
        add(Kind::open_edge, uses[0].facet,
            fmt::format("not closed: {} has no second facet", ends(edge)));
      } else if (uses.size() % 2 == 1) {
        add(Kind::crowded_edge, uses.back().facet,
            fmt::format("{} has {} facets, where 2 belong", ends(edge), uses.size()));
      }
    }
  }

  // Walks each shell over the edges of two facets and turns every facet as its first one. Turned
  // and unturned facets disagree; the smaller group is wrong.
  void find_shell_faults() {
    std::vector<int> turn(mesh_.triangles.size(), 0);  // 0: not seen; 1 as it is; -1 turned
    for (std::size_t first = 0; first < turn.size(); ++first) {
      if (!used_[first] || turn[first] != 0) continue;
      std::vector<std::size_t> shell{first};
      bool closed = true;
      turn[first] = 1;
      for (std::size_t n = 0; n < shell.size(); ++n) {
        for (std::size_t k = 0; k < 3; ++k) {
          const std::size_t a = mesh_.triangles[shell[n]][k];
          const std::size_t b = mesh_.triangles[shell[n]][(k + 1) % 3];
          const auto& uses = edges_.at({std::min(a, b), std::max(a, b)});
          closed = closed && uses.size() % 2 == 0;
          if (uses.size() != 2) continue;
          const EdgeUse& other = uses[uses[0].facet == shell[n] ? 1 : 0];
          if (turn[other.facet] != 0) continue;
          turn[other.facet] = uses[0].forward == uses[1].forward ? -turn[shell[n]] : turn[shell[n]];
          shell.push_back(other.facet);
        }
      }
      judge_shell(shell, closed, turn);
    }
  }

  void judge_shell(const std::vector<std::size_t>& shell, bool closed,
                   const std::vector<int>& turn) {
    const auto turned = std::count_if(shell.begin(), shell.end(),
                                      [&](std::size_t facet) { return turn[facet] < 0; });
    const int right = 2 * turned > static_cast<std::ptrdiff_t>(shell.size()) ? -1 : 1;
    double shell_volume = 0;
    const Eigen::Vector3d& o = mesh_.vertices[mesh_.triangles[shell[0]][0]];
    for (const std::size_t facet : shell) {
      const auto& t = mesh_.triangles[facet];
      if (turn[facet] != right) {
        add(Kind::flipped, facet,
            fmt::format("is flipped against its neighbours, at {}; reverse its corners",
                        point(mesh_.vertices[t[0]])));
      }
      shell_volume += right * turn[facet] * tetrahedron_volume(mesh_.corners(facet), o);
    }
    if (closed && shell_volume < 0) {
      add(Kind::inverted, shell[0],
          fmt::format(
              "its shell of {} facets faces inwards (volume {:.6g} m3); reverse every facet",
              shell.size(), shell_volume));
    }
  }

  const TriangleMesh& mesh_;
  double least_height_;
  std::vector<bool> used_;
  std::map<Edge, std::vector<EdgeUse>> edges_;
  std::vector<MeshFault> faults_;
};

}  // namespace

std::vector<MeshFault> check_mesh(const TriangleMesh& mesh) { return Checker(mesh).run(); }

double smallest_angle(const TriangleMesh& mesh, std::size_t facet) {
  const Triangle t = mesh.corners(facet);
  double smallest = M_PI;
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3d a = t[(i + 1) % 3] - t[i], b = t[(i + 2) % 3] - t[i];
    smallest = std::min(smallest, std::atan2(a.cross(b).norm(), a.dot(b)));
  }
  return smallest;
}

std::vector<MeshFault> check_angles(const TriangleMesh& mesh, double least_angle) {
  std::vector<MeshFault> faults;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const double angle = smallest_angle(mesh, i);
    if (angle >= least_angle) continue;
    faults.push_back(
        {MeshFault::Kind::degenerate, i + 1,
         fmt::format("facet {}: its smallest angle is {:.2g} deg, at {}; LIGGGHTS takes "
                     "{:.2g} deg and more: join it with its neighbours",
                     i + 1, degrees(angle), point(mesh.corners(i)[0]), degrees(least_angle))});
  }
  return faults;
}

}  // namespace dipper::mesh
