#include "common/mesh/mass_properties.hpp"

namespace dipper::mesh {

using Eigen::Matrix3d;
using Eigen::Vector3d;

MassProperties mass_properties(const TriangleMesh& mesh) {
  MassProperties m;
  if (mesh.vertices.empty()) return m;
  m.area_m2 = area(mesh);
  m.volume_m3 = volume(mesh);
  const Vector3d& o = mesh.vertices[0];  // as in volume(): a mesh far away keeps its digits
  Vector3d first = Vector3d::Zero();
  Matrix3d second = Matrix3d::Zero();  // integral of (x - o) (x - o)^T
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Triangle t = mesh.corners(i);
    const double v = tetrahedron_volume(t, o);
    Vector3d sum = Vector3d::Zero();
    Matrix3d squares = Matrix3d::Zero();
    for (const Vector3d& p : t) {
      sum += p - o;
      squares += (p - o) * (p - o).transpose();
    }
    first += v / 4 * sum;
    second += v / 20 * (squares + sum * sum.transpose());
  }
  const Vector3d from_o = first / m.volume_m3;
  m.com_m = o + from_o;
  const Matrix3d central = second - m.volume_m3 * from_o * from_o.transpose();
  m.inertia_m5 = central.trace() * Matrix3d::Identity() - central;
  return m;
}

}  // namespace dipper::mesh
