// The scanned surface of the bench: an open mesh, seen from above.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "common/mesh/triangle_mesh.hpp"
#include "coupler/case/outline_file.hpp"

namespace dipper::cases {

/// z(x, y) in W of a mesh that lies over the bench from its least x, the toe, to its largest, the
/// rear wall. The facets' orientation is ignored, and upright facets are steps.
class BenchSurface {
 public:
  explicit BenchSurface(mesh::TriangleMesh mesh);

  /// The height of the facet over or under this place, else of the nearest within kReach_m. 0, the
  /// ground, in front of the toe, far from any facet, and where a facet is lower; the height of the
  /// edge behind the rear and beside the mesh.
  double height(double x_m, double y_m) const;

  /// At each x, the quantile `share` of the height over the strip |y| <= half_width: 1 the highest,
  /// 0.5 the median.
  BenchOutline section(double half_width_m, double share) const;

  /// Faults of the mesh as a surface of that strip: places without a facet, places with two facets
  /// at different heights (both checked every kStep_m, and the second at facets' middles), and
  /// places below the ground.
  std::vector<std::string> faults(double half_width_m) const;

  const mesh::TriangleMesh& mesh() const { return mesh_; }

  static constexpr double kStep_m = 0.1;    ///< less than a rock
  static constexpr double kReach_m = 0.1;   ///< beyond an edge, over gaps between the steps
  static constexpr double kFloor_m = 0.25;  ///< by which a scanned floor may be below the ground

 private:
  struct Hit {
    double inside_m;  ///< to the nearest edge, seen from above; negative outside
    double z_m;
  };
  std::vector<Hit> hits(double x_m, double y_m) const;  ///< the facets in reach
  std::array<std::size_t, 2> cell(double x_m, double y_m) const;

  mesh::TriangleMesh mesh_;
  Box box_;
  std::size_t cells_ = 1;  ///< along a side of the grid over the box
  std::vector<std::vector<std::size_t>> facets_in_;
};

}  // namespace dipper::cases
