// Closed solids of few triangles, for drawings.
#pragma once

#include <vector>

#include "common/mesh/triangle_mesh.hpp"

namespace dipper::mesh {

/// The solid between two polygons of as many corners [m], each convex; the corners of one are
/// joined to those of the other in their order.
TriangleMesh prism(const std::vector<Eigen::Vector3d>& a, const std::vector<Eigen::Vector3d>& b);

/// From the smaller to the larger corner [m].
TriangleMesh block(const Eigen::Vector3d& low, const Eigen::Vector3d& high);

/// A polygon in x and z [m], from y = `right` to y = `left`.
TriangleMesh plate(const std::vector<Eigen::Vector2d>& outline, double right, double left);

/// A rod of `sides` flat sides along points [m], square to its path at both ends.
TriangleMesh rod(const std::vector<Eigen::Vector3d>& way, double radius, std::size_t sides);

/// A disc or a ring about an axis along y through `centre`: a section of (distance from the axis,
/// y) [m] turned in `sides` steps.
TriangleMesh turned(const std::vector<Eigen::Vector2d>& section, const Eigen::Vector3d& centre,
                    std::size_t sides);

void append(TriangleMesh& to, const TriangleMesh& more);

/// The mesh and its image in the plane y = 0.
TriangleMesh both_sides(const TriangleMesh& left);

}  // namespace dipper::mesh
