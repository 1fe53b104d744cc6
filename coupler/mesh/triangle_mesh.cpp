#include "coupler/mesh/triangle_mesh.hpp"

#include <Eigen/Geometry>
#include <limits>

namespace dipper::mesh {

double facet_area(const TriangleMesh& mesh, std::size_t triangle) {
  const auto& t = mesh.triangles[triangle];
  const Eigen::Vector3d& a = mesh.vertices[t[0]];
  return 0.5 * (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a).norm();
}

double area(const TriangleMesh& mesh) {
  double sum = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) sum += facet_area(mesh, i);
  return sum;
}

double volume(const TriangleMesh& mesh) {
  if (mesh.vertices.empty()) return 0;
  // About a vertex instead of the origin: a small mesh far away would lose its digits.
  const Eigen::Vector3d& o = mesh.vertices[0];
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    sum +=
        (mesh.vertices[t[0]] - o).dot((mesh.vertices[t[1]] - o).cross(mesh.vertices[t[2]] - o)) / 6;
  }
  return sum;
}

BoundingBox bounding_box(const TriangleMesh& mesh) {
  const double huge = std::numeric_limits<double>::infinity();
  BoundingBox box{Eigen::Vector3d::Constant(huge), Eigen::Vector3d::Constant(-huge)};
  for (const Eigen::Vector3d& v : mesh.vertices) {
    box.min = box.min.cwiseMin(v);
    box.max = box.max.cwiseMax(v);
  }
  return box;
}

}  // namespace dipper::mesh
