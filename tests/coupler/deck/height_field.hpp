// Open surface meshes for tests.
#pragma once

#include <functional>
#include <vector>

#include "common/mesh/triangle_mesh.hpp"

namespace dipper::deck {

/// z(x, y) over the grid of these lines, two facets a cell.
inline mesh::TriangleMesh height_field(const std::vector<double>& x, const std::vector<double>& y,
                                       const std::function<double(double, double)>& z) {
  mesh::TriangleMesh mesh;
  const auto at = [&](std::size_t i, std::size_t j) {
    return Eigen::Vector3d(x[i], y[j], z(x[i], y[j]));
  };
  for (std::size_t i = 0; i + 1 < x.size(); ++i)
    for (std::size_t j = 0; j + 1 < y.size(); ++j) {
      mesh.add_loose({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.add_loose({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return mesh;
}

/// Adds another's facets.
inline void add(mesh::TriangleMesh& mesh, const mesh::TriangleMesh& other) {
  for (std::size_t i = 0; i < other.triangles.size(); ++i) mesh.add_loose(other.corners(i));
}

}  // namespace dipper::deck
