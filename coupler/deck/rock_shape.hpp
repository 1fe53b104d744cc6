// A rock shape: the mesh that gives it mass and inertia, the spheres that touch.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "common/mesh/mass_properties.hpp"
#include "coupler/deck/sphere_fit.hpp"

namespace dipper::deck {

/// Number of spheres for a mesh: rock.shape_resolution.
struct ShapeResolution {
  const char* name;
  int spheres;
};
inline constexpr std::array<ShapeResolution, 3> kShapeResolutions = {
    {{"coarse", 6}, {"medium", 12}, {"fine", 24}}};

/// Spheres of a rock of that resolution. Throws std::invalid_argument for an unknown one.
int spheres_a_rock(const std::string& resolution);

/// The spheres for contacts, and their deviation from the mesh.
struct SphereFit {
  std::vector<Sphere> spheres;
  double union_volume_error = 0;    ///< (union - mesh) / mesh
  double symmetric_difference = 0;  ///< volume in just one of them, by the mesh's
};

/// Of volume-equivalent diameter 1 m, origin at the centre of mass. A rock of size s and density
/// rho: lengths times s, mass rho s^3 V, inertia rho s^5 J.
struct RockShape {
  std::string name;
  std::string mesh_sha256;    ///< of the STL it was made from
  mesh::MassProperties mass;  ///< of the mesh, exact
  double aspect_ratio = 1;    ///< L/I: longest by middle side of the principal box
  double flatness = 1;        ///< S/I: shortest by middle side of that box
  double sphericity = 1;      ///< area of the sphere of the same volume by area (Wadell)
  std::map<std::string, SphereFit> fits;  ///< by the resolution's name

  /// Throws std::invalid_argument for an unknown name.
  const SphereFit& fit(const std::string& resolution) const;
};

/// Scales a sound mesh (rock_faults) to diameter 1 m about its centre of mass and fits spheres, as
/// many as each resolution says. Throws std::invalid_argument naming the first fault.
RockShape make_rock_shape(const std::string& name, mesh::TriangleMesh mesh,
                          const std::vector<ShapeResolution>& resolutions = {
                              kShapeResolutions.begin(), kShapeResolutions.end()});

/// Faults that make a mesh unfit as a rock: those of check_mesh, or more than one shell.
std::vector<std::string> rock_faults(const mesh::TriangleMesh& mesh);

/// The text of meshes/rocks/NAME.yaml; the comment lines name the units.
std::string to_yaml(const RockShape& shape);

/// Reads such a file. Throws std::runtime_error naming file and key.
RockShape read_rock_shape(const std::filesystem::path& file);

}  // namespace dipper::deck
