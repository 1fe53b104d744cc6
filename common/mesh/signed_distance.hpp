// How far inside or outside a mesh a point lies.
#pragma once

#include "common/mesh/triangle_mesh.hpp"

namespace dipper::mesh {

/// Distance [m] of p to the surface of a closed mesh; positive inside (winding number), negative
/// outside.
double signed_distance(const TriangleMesh& mesh, const Eigen::Vector3d& p);

/// Whether the surface comes as close to p as `distance_m`.
bool is_surface_near(const TriangleMesh& mesh, const Eigen::Vector3d& p, double distance_m);

}  // namespace dipper::mesh
