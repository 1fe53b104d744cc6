#include "common/mesh/lining.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <map>
#include <stdexcept>
#include <vector>

namespace dipper::mesh {
namespace {

Eigen::Vector3d unit_normal(const Triangle& t) {
  return (t[1] - t[0]).cross(t[2] - t[0]).normalized();
}

/// The shortest move that brings every face at a vertex forward by `thickness`: least squares, as
/// the faces of a flat plate give one equation several times. Solved in the principal axes of the
/// normals (the pseudo-inverse of their 3 x 3 matrix), without those along which no normal points.
Eigen::Vector3d offset(const std::vector<Eigen::Vector3d>& normals, double thickness) {
  constexpr double kNoNormal = 1e-10;  // squared sine of an angle
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& n : normals) {
    products += n * n.transpose();
    sum += n;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(products);
  Eigen::Vector3d move = Eigen::Vector3d::Zero();
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d axis = axes.eigenvectors().col(i);
    const double weight = axes.eigenvalues()[i];
    if (weight > kNoNormal) move += thickness * axis.dot(sum) / weight * axis;
  }
  return move;
}

/// Mass properties of `whole` without `part`, both at density 1.
MassProperties difference(const MassProperties& whole, const MassProperties& part) {
  const auto about_origin = [](const MassProperties& m) -> Eigen::Matrix3d {
    const Eigen::Vector3d& c = m.com_m;
    return m.inertia_m5 +
           m.volume_m3 * (c.squaredNorm() * Eigen::Matrix3d::Identity() - c * c.transpose());
  };
  MassProperties d;
  d.volume_m3 = whole.volume_m3 - part.volume_m3;
  d.com_m = (whole.volume_m3 * whole.com_m - part.volume_m3 * part.com_m) / d.volume_m3;
  const Eigen::Vector3d& c = d.com_m;
  d.inertia_m5 = about_origin(whole) - about_origin(part) -
                 d.volume_m3 * (c.squaredNorm() * Eigen::Matrix3d::Identity() - c * c.transpose());
  return d;
}

}  // namespace

Lining line_dipper(const TriangleMesh& dipper, const Box& cavity, double thickness,
                   LinedFaces faces) {
  const Eigen::Vector3d size = cavity.sides_m();
  const Eigen::Vector3d middle = 0.5 * (cavity.min_m + cavity.max_m);
  if (!(thickness > 0 && thickness < size.minCoeff() / 4)) {
    throw std::invalid_argument(
        fmt::format("a layer of {:g} m does not fit a cavity of {:g} m; allowed is > 0 and < {:g}",
                    thickness, size.minCoeff(), size.minCoeff() / 4));
  }
  // Not along x, where the teeth begin.
  const double margin = 0.1 * size.minCoeff();
  const Eigen::Vector3d grown = 0.5 * size + Eigen::Vector3d(0, margin, margin);
  std::map<std::size_t, std::vector<Eigen::Vector3d>> normals;  // of the inner faces at a vertex
  for (std::size_t i = 0; i < dipper.triangles.size(); ++i) {
    const Triangle t = dipper.corners(i);
    const Eigen::Vector3d n = unit_normal(t);
    const Eigen::Vector3d from_middle = (t[0] + t[1] + t[2]) / 3 - middle;
    const bool inside = (from_middle.cwiseAbs().array() <= grown.array()).all();
    const bool inwards = n.dot(from_middle) < 0 && std::abs(n.x()) < 0.7;
    if (!inside || !inwards || (faces == LinedFaces::floor && n.z() < 0.7)) continue;
    for (const std::size_t v : dipper.triangles[i]) normals[v].push_back(n);
  }
  if (normals.empty()) {
    throw std::invalid_argument("the dipper's mesh has no plates around its cavity to line");
  }
  Lining lined{dipper, {}};
  for (const auto& [v, n] : normals) lined.mesh.vertices[v] += offset(n, thickness);
  lined.layer = difference(mass_properties(lined.mesh), mass_properties(dipper));
  return lined;
}

}  // namespace dipper::mesh
