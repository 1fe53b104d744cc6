// Exact mass properties of the solid in a mesh.
#pragma once

#include "common/mesh/triangle_mesh.hpp"

namespace dipper::mesh {

/// Of the enclosed solid at density 1, to be multiplied by a density [kg/m3].
struct MassProperties {
  double volume_m3 = 0;
  double area_m2 = 0;
  Eigen::Vector3d com_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d inertia_m5 = Eigen::Matrix3d::Zero();  ///< about com_m, mesh axes
};

/// Exact for a closed mesh: the divergence theorem, as a sum of signed tetrahedra (Tonon 2004,
/// J. Math. Stat. 1:8). Negative volume: the mesh is inside out.
MassProperties mass_properties(const TriangleMesh& mesh);

}  // namespace dipper::mesh
