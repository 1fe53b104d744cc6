#include "common/mesh/triangle_mesh.hpp"

#include <Eigen/Geometry>

namespace dipper::mesh {

Triangle TriangleMesh::corners(std::size_t triangle) const {
  const auto& t = triangles[triangle];
  return {vertices[t[0]], vertices[t[1]], vertices[t[2]]};
}

void TriangleMesh::add_loose(const Triangle& triangle) {
  const std::size_t n = vertices.size();
  vertices.insert(vertices.end(), triangle.begin(), triangle.end());
  triangles.push_back({n, n + 1, n + 2});
}

double facet_area(const TriangleMesh& mesh, std::size_t triangle) {
  const auto [a, b, c] = mesh.corners(triangle);
  return 0.5 * (b - a).cross(c - a).norm();
}

double area(const TriangleMesh& mesh) {
  double sum = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) sum += facet_area(mesh, i);
  return sum;
}

double tetrahedron_volume(const Triangle& triangle, const Eigen::Vector3d& apex) {
  const auto& [a, b, c] = triangle;
  return (a - apex).dot((b - apex).cross(c - apex)) / 6;
}

double volume(const TriangleMesh& mesh) {
  if (mesh.vertices.empty()) return 0;
  // About a vertex instead of the origin: a small mesh far away would lose its digits.
  double sum = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    sum += tetrahedron_volume(mesh.corners(i), mesh.vertices[0]);
  return sum;
}

Box bounding_box(const TriangleMesh& mesh) {
  Box box;
  for (const Eigen::Vector3d& v : mesh.vertices) box.add(v);
  return box;
}

}  // namespace dipper::mesh
