#include "coupler/deck/rock_shape.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace dipper {

using Eigen::Matrix3d;
using Eigen::Vector3d;

RockShape make_rock_shape(const std::string& name, TriangleMesh mesh, int spheres) {
  const MassProperties raw = mass_properties(mesh);
  const double scale = std::cbrt(M_PI / 6 / raw.volume_m3);
  for (Vector3d& v : mesh.vertices) v = scale * (v - raw.com_m);
  RockShape shape;
  shape.name = name;
  shape.spheres = fit_spheres(mesh, spheres);
  shape.mass = mass_properties(mesh);
  const Matrix3d axes =
      Eigen::SelfAdjointEigenSolver<Matrix3d>(shape.mass.inertia_m5).eigenvectors();
  BoundingBox box;
  for (const Vector3d& v : mesh.vertices) box.add(axes.transpose() * v);
  Vector3d sides = box.max - box.min;
  std::sort(sides.data(), sides.data() + 3);
  shape.aspect_ratio = sides[2] / sides[1];
  shape.flatness = sides[0] / sides[1];
  shape.sphericity = std::cbrt(M_PI * std::pow(6 * shape.mass.volume_m3, 2)) / shape.mass.area_m2;
  shape.union_volume_error = union_volume(shape.spheres, 400) / shape.mass.volume_m3 - 1;
  shape.symmetric_difference = symmetric_difference(mesh, shape.spheres);
  return shape;
}

std::string to_yaml(const RockShape& s) {
  const Matrix3d& J = s.mass.inertia_m5;
  const Vector3d& c = s.mass.com_m;
  const auto zero = [](double v) { return std::abs(v) < 1e-9 ? 0.0 : v; };
  std::string out = fmt::format(
      "# Written by scripts/make_meshes (program rock-shape) from {}.stl.\n"
      "name: {}\n"
      "source: assumed shape of blasted rock; corners in scripts/make_meshes\n"
      "units: m (volume-equivalent diameter 1 m), density 1\n"
      "volume: {:.9g}\narea: {:.9g}\ncentre_of_mass: [{:.9g}, {:.9g}, {:.9g}]\n"
      "inertia: [{:.9g}, {:.9g}, {:.9g}, {:.9g}, {:.9g}, {:.9g}]   # xx xy xz yy yz zz\n"
      "aspect_ratio: {:.4g}\nflatness: {:.4g}\nsphericity: {:.4g}\n"
      "union_volume_error: {:.2g}\nsymmetric_difference: {:.3g}\n"
      "spheres:   # [x, y, z, radius]\n",
      s.name, s.name, s.mass.volume_m3, s.mass.area_m2, zero(c.x()), zero(c.y()), zero(c.z()),
      J(0, 0), J(0, 1), J(0, 2), J(1, 1), J(1, 2), J(2, 2), s.aspect_ratio, s.flatness,
      s.sphericity, s.union_volume_error, s.symmetric_difference);
  for (const Sphere& q : s.spheres)
    out += fmt::format("  - [{:.6f}, {:.6f}, {:.6f}, {:.6f}]\n", q.centre_m.x(), q.centre_m.y(),
                       q.centre_m.z(), q.radius_m);
  return out;
}

RockShape read_rock_shape(const std::filesystem::path& file) try {
  const YAML::Node y = YAML::LoadFile(file.string());
  RockShape s;
  s.name = y["name"].as<std::string>();
  s.mass.volume_m3 = y["volume"].as<double>();
  s.mass.area_m2 = y["area"].as<double>();
  const auto J = y["inertia"].as<std::vector<double>>();
  if (J.size() != 6) throw std::runtime_error("inertia: six numbers expected");
  s.mass.inertia_m5 << J[0], J[1], J[2], J[1], J[3], J[4], J[2], J[4], J[5];
  s.aspect_ratio = y["aspect_ratio"].as<double>();
  s.flatness = y["flatness"].as<double>();
  s.sphericity = y["sphericity"].as<double>();
  s.union_volume_error = y["union_volume_error"].as<double>();
  s.symmetric_difference = y["symmetric_difference"].as<double>();
  for (const auto& row : y["spheres"].as<std::vector<std::vector<double>>>()) {
    if (row.size() != 4) throw std::runtime_error("spheres: rows of x, y, z, radius expected");
    s.spheres.push_back({Vector3d(row[0], row[1], row[2]), row[3]});
  }
  if (s.spheres.empty()) throw std::runtime_error("spheres: at least one expected");
  return s;
} catch (const std::exception& e) {
  throw std::runtime_error(file.string() + ": " + e.what());
}

}  // namespace dipper
