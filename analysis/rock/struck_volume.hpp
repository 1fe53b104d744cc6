// The struck volume of a dipper, from its mesh alone.
#pragma once

#include "common/mesh/triangle_mesh.hpp"

namespace dipper::analysis::rock {

/// The water that a vessel holds: the struck capacity, with the surface at the lip and the roof's
/// edges, is that in the position in which it holds most.
struct StruckVolume {
  double volume_m3 = 0;
  Eigen::Vector3d up = Eigen::Vector3d::Zero();  ///< upward direction, in the mesh's axes
  Box water;                                     ///< bounding box of the water, in the mesh's axes
};

struct StruckOptions {
  double cell_m = 0;  ///< 0: 1/60 of the mesh's longest side
};

/// Fills the mesh (walls and plates, closed shells) with water, in cells: a cell holds water when
/// every way out of it first goes up, found by one priority flood (Barnes et al. 2014, Comput.
/// Geosci. 62:117). Two cells are connected unless a triangle crosses the line between their
/// centres, so plates thinner than a cell are tight. Searches the position with coarse cells, then
/// measures with two cell sizes and extrapolates: the error is of the order of half a cell's height
/// times the opening. A vessel with a gap wider than a cell is empty: close the door.
StruckVolume struck_volume(const mesh::TriangleMesh& mesh, const StruckOptions& options = {});

/// The water held in this position, in cells of this size [m3].
double water_held(const mesh::TriangleMesh& mesh, const Eigen::Vector3d& up, double cell_m,
                  Box* water = nullptr);

}  // namespace dipper::analysis::rock
