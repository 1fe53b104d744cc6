// What a dipper holds, from its mesh alone.
#pragma once

#include "common/mesh/triangle_mesh.hpp"

namespace dipper::analysis::rock {

/// The water a vessel holds: the struck capacity, whose surface goes through the lip's and the
/// roof's edges, is that of the position in which it holds most.
struct StruckVolume {
  double volume_m3 = 0;
  Eigen::Vector3d up = Eigen::Vector3d::Zero();  ///< in the mesh's axes, held so
  Box water;                                     ///< around it, in the mesh's axes
};

struct StruckOptions {
  double cell_m = 0;  ///< 0: 1/60 of the mesh's longest side
};

/// Fills the mesh (walls, plates and all, closed shells) with water, in cells: a cell holds water
/// when every way out of it first goes up, which one pass of a priority flood tells (Barnes et al.
/// 2014, Comput. Geosci. 62:117). Two cells are connected unless a triangle crosses the line
/// between their centres, so that plates thinner than a cell hold. Searches the position with
/// coarse cells, then measures with two sizes of cells and extrapolates: the error is of the order
/// of a cell's half height times the opening. A vessel with a gap wider than a cell runs dry: shut
/// the door.
StruckVolume struck_volume(const mesh::TriangleMesh& mesh, const StruckOptions& options = {});

/// The water held with `up` up, in cells of this size [m3].
double water_held(const mesh::TriangleMesh& mesh, const Eigen::Vector3d& up, double cell_m,
                  Box* water = nullptr);

}  // namespace dipper::analysis::rock
