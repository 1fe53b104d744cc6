// A rock shape: the mesh that gives it mass and inertia, the spheres that touch.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "coupler/deck/sphere_fit.hpp"
#include "coupler/mesh/mass_properties.hpp"

namespace dipper {

/// Of volume-equivalent diameter 1 m, origin at the centre of mass. A rock of size s and density
/// rho: lengths times s, mass rho s^3 V, inertia rho s^5 J.
struct RockShape {
  std::string name;
  MassProperties mass;              ///< of the mesh, exact
  std::vector<Sphere> spheres;      ///< what contacts see
  double aspect_ratio = 1;          ///< longest by middle side of the box along the principal axes
  double flatness = 1;              ///< shortest by middle side of that box
  double sphericity = 1;            ///< area of the sphere of the same volume by area (Wadell)
  double union_volume_error = 0;    ///< (union - mesh) / mesh
  double symmetric_difference = 0;  ///< volume in just one of them, by the mesh's
};

/// Scales a sound mesh (check_mesh) to diameter 1 m about its centre of mass and fits `spheres`
/// spheres. Throws std::invalid_argument naming the first fault.
RockShape make_rock_shape(const std::string& name, TriangleMesh mesh, int spheres);

/// What meshes/rocks/NAME.yaml holds; the comment lines name the units.
std::string to_yaml(const RockShape& shape);

/// Reads such a file. Throws std::runtime_error naming file and key.
RockShape read_rock_shape(const std::filesystem::path& file);

}  // namespace dipper
