// Closed triangle meshes: reading them, and exact mass properties.
#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <vector>

namespace dipper {

/// Corners [m], counter-clockwise seen from outside.
using Triangle = std::array<Eigen::Vector3d, 3>;
using TriangleMesh = std::vector<Triangle>;

/// Reads an STL, ASCII or binary. Throws std::runtime_error naming the file when it is none.
TriangleMesh read_stl(const std::filesystem::path& file);

/// True when every edge is used once in each direction (corners within 1e-6 m are one): closed,
/// consistently oriented, no T-junctions, no duplicates.
bool is_closed(const TriangleMesh& mesh);

/// Of the enclosed solid at density 1: what a density [kg/m3] multiplies.
struct MassProperties {
  double volume_m3 = 0;
  double area_m2 = 0;
  Eigen::Vector3d com_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d inertia_m5 = Eigen::Matrix3d::Zero();  ///< about com_m, mesh axes
};

/// Exact for a closed mesh: the divergence theorem, as a sum of signed tetrahedra with the origin
/// (Tonon 2004, J. Math. Stat. 1:8). Negative volume: the mesh is inside out.
MassProperties mass_properties(const TriangleMesh& mesh);

/// Distance [m] of p to the surface; positive inside (winding number), negative outside.
double signed_distance(const TriangleMesh& mesh, const Eigen::Vector3d& p);

}  // namespace dipper
