// A triangle mesh and what it measures.
// In a namespace of its own: the decks have a mesh of their own, of loose facets.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

namespace dipper::mesh {

/// Triangles over shared vertices [m]; the right-hand rule gives the outside.
struct TriangleMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<std::size_t, 3>> triangles;  ///< in the order of the file's facets
};

/// An axis-aligned box [m]. Empty (min > max) for a mesh without vertices.
struct BoundingBox {
  Eigen::Vector3d min;
  Eigen::Vector3d max;
};

double facet_area(const TriangleMesh& mesh, std::size_t triangle);  ///< [m2]
double area(const TriangleMesh& mesh);                              ///< [m2]

/// Signed volume [m3] by the divergence theorem, sum of v0·(v1 x v2)/6: negative when the facets
/// face inwards, without meaning when the mesh is open.
double volume(const TriangleMesh& mesh);

BoundingBox bounding_box(const TriangleMesh& mesh);

}  // namespace dipper::mesh
