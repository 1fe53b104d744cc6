#include "coupler/deck/rock_shape.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <stdexcept>

#include "common/input_error.hpp"
#include "common/mesh/mesh_check.hpp"
#include "common/yaml_section.hpp"

namespace dipper::deck {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

/// Connected by shared vertices.
std::size_t shells(const mesh::TriangleMesh& mesh) {
  std::vector<std::size_t> parent(mesh.vertices.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const auto& t : mesh.triangles)
    for (const std::size_t v : {t[1], t[2]}) parent[root(v)] = root(t[0]);
  std::set<std::size_t> roots;
  for (const auto& t : mesh.triangles) roots.insert(root(t[0]));
  return roots.size();
}

}  // namespace

const SphereFit& RockShape::fit(const std::string& resolution) const {
  const auto found = fits.find(resolution);
  if (found == fits.end())
    throw std::invalid_argument(
        fmt::format("rock shape {}: no spheres for the resolution {}", name, resolution));
  return found->second;
}

std::vector<std::string> rock_faults(const mesh::TriangleMesh& mesh) {
  std::vector<std::string> out;
  for (const mesh::MeshFault& fault : mesh::check_mesh(mesh)) out.push_back(fault.message);
  if (const std::size_t n = shells(mesh); out.empty() && n > 1)
    out.push_back(fmt::format("{} separate shells; a rock is one: keep the largest", n));
  return out;
}

int spheres_a_rock(const std::string& resolution) {
  for (const ShapeResolution& r : kShapeResolutions)
    if (r.name == resolution) return r.spheres;
  throw std::invalid_argument("no shape resolution " + resolution);
}

RockShape make_rock_shape(const std::string& name, mesh::TriangleMesh mesh,
                          const std::vector<ShapeResolution>& resolutions) {
  if (const auto faults = rock_faults(mesh); !faults.empty())
    throw std::invalid_argument(faults[0]);
  // A scan may be in a mine's coordinates, whose products lose digits.
  const Box around = mesh::bounding_box(mesh);
  for (Vector3d& v : mesh.vertices) v -= (around.min_m + around.max_m) / 2;
  const mesh::MassProperties raw = mesh::mass_properties(mesh);
  const double scale = std::cbrt(M_PI / 6 / raw.volume_m3);
  for (Vector3d& v : mesh.vertices) v = scale * (v - raw.com_m);
  RockShape shape;
  shape.name = name;
  shape.mass = mesh::mass_properties(mesh);
  const Matrix3d axes =
      Eigen::SelfAdjointEigenSolver<Matrix3d>(shape.mass.inertia_m5).eigenvectors();
  Box box;
  for (const Vector3d& v : mesh.vertices) box.add(axes.transpose() * v);
  Vector3d sides = box.sides_m();
  std::sort(sides.data(), sides.data() + 3);
  shape.aspect_ratio = sides[2] / sides[1];
  shape.flatness = sides[0] / sides[1];
  shape.sphericity = std::cbrt(M_PI * std::pow(6 * shape.mass.volume_m3, 2)) / shape.mass.area_m2;
  for (const ShapeResolution& r : resolutions) {
    SphereFit& fit = shape.fits[r.name];
    fit.spheres = fit_spheres(mesh, r.spheres);
    fit.union_volume_error = union_volume(fit.spheres, 400) / shape.mass.volume_m3 - 1;
    fit.symmetric_difference = symmetric_difference(mesh, fit.spheres);
  }
  return shape;
}

std::string to_yaml(const RockShape& s) {
  const Matrix3d& J = s.mass.inertia_m5;
  const Vector3d& c = s.mass.com_m;
  const auto zero = [](double v) { return std::abs(v) < 1e-9 ? 0.0 : v; };
  std::string out = fmt::format(
      "# Written by rock-shape from {}.stl: made anew when that file is another.\n"
      "name: {}\n"
      "mesh_sha256: {}\n"
      "units: m (volume-equivalent diameter 1 m), density 1\n"
      "volume: {:.9g}\narea: {:.9g}\ncentre_of_mass: [{:.9g}, {:.9g}, {:.9g}]\n"
      "inertia: [{:.9g}, {:.9g}, {:.9g}, {:.9g}, {:.9g}, {:.9g}]   # xx xy xz yy yz zz\n"
      "aspect_ratio: {:.4g}   # L/I\nflatness: {:.4g}   # S/I\nsphericity: {:.4g}\n"
      "resolutions:   # spheres: [x, y, z, radius]\n",
      s.name, s.name, s.mesh_sha256, s.mass.volume_m3, s.mass.area_m2, zero(c.x()), zero(c.y()),
      zero(c.z()), J(0, 0), J(0, 1), J(0, 2), J(1, 1), J(1, 2), J(2, 2), s.aspect_ratio, s.flatness,
      s.sphericity);
  for (const auto& [name, fit] : s.fits) {
    out += fmt::format(
        "  {}:   # {} spheres\n    union_volume_error: {:.2g}\n    symmetric_difference: {:.3g}\n"
        "    spheres:\n",
        name, fit.spheres.size(), fit.union_volume_error, fit.symmetric_difference);
    for (const Sphere& q : fit.spheres)
      out += fmt::format("      - [{:.6f}, {:.6f}, {:.6f}, {:.6f}]\n", q.centre_m.x(),
                         q.centre_m.y(), q.centre_m.z(), q.radius_m);
  }
  return out;
}

RockShape read_rock_shape(const std::filesystem::path& file) {
  std::vector<Finding> faults;
  const YamlTree tree = read_yaml(file, faults);
  if (!faults.empty()) throw InputError(std::move(faults));
  YamlSection y(tree, "", faults, "the output of rock-shape");
  RockShape s;
  s.name = y.text("name", "the shape's name");
  s.mesh_sha256 = y.text("mesh_sha256", "the SHA-256 of the mesh it was made from");
  s.mass.volume_m3 = y.number("volume", "a number in m3");
  s.mass.area_m2 = y.number("area", "a number in m2");
  const auto J = y.numbers("inertia", 6, "six numbers, xx xy xz yy yz zz");
  s.mass.inertia_m5 << J[0], J[1], J[2], J[1], J[3], J[4], J[2], J[4], J[5];
  s.aspect_ratio = y.number("aspect_ratio", "a number");
  s.flatness = y.number("flatness", "a number");
  s.sphericity = y.number("sphericity", "a number");
  YamlSection resolutions = y.section("resolutions", "coarse, medium and fine");
  for (const ShapeResolution& r : kShapeResolutions) {
    YamlSection section = resolutions.section(r.name, "the file again with rock-shape");
    SphereFit& fit = s.fits[r.name];
    fit.union_volume_error = section.number("union_volume_error", "a number");
    fit.symmetric_difference = section.number("symmetric_difference", "a number");
    const YamlTree* spheres = section.need("spheres", "a list of [x, y, z, radius]");
    if (spheres == nullptr) continue;
    for (const auto& [index, node] : spheres->children) {
      const auto q = section.numbers_at(node, "spheres." + index, 4, "x, y, z, radius");
      fit.spheres.push_back({Vector3d(q[0], q[1], q[2]), q[3]});
    }
    if (fit.spheres.empty())
      section.fault(*spheres, "spheres", "is empty; write a list of [x, y, z, radius]");
  }
  if (!faults.empty()) throw InputError(std::move(faults));
  return s;
}

}  // namespace dipper::deck
