// A triangle mesh, its area and volume.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "common/box.hpp"

namespace dipper::mesh {

/// Corners [m], counter-clockwise seen from outside.
using Triangle = std::array<Eigen::Vector3d, 3>;

/// Triangles over shared vertices [m]; the right-hand rule gives the outside.
struct TriangleMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<std::size_t, 3>> triangles;  ///< in the order of the file's facets

  Triangle corners(std::size_t triangle) const;

  /// Adds three vertices, shared with no other triangle: for surfaces that are only written.
  void add_loose(const Triangle& triangle);
};

double facet_area(const TriangleMesh& mesh, std::size_t triangle);  ///< [m2]
double area(const TriangleMesh& mesh);                              ///< [m2]

/// Signed volume [m3] of the tetrahedron between a triangle and `apex`: positive when the apex is
/// on the triangle's inside.
double tetrahedron_volume(const Triangle& triangle, const Eigen::Vector3d& apex);

/// Signed volume [m3] by the divergence theorem, the sum of those tetrahedra: negative when the
/// facets face inwards, without meaning when the mesh is open.
double volume(const TriangleMesh& mesh);

Box bounding_box(const TriangleMesh& mesh);

}  // namespace dipper::mesh
