// A solid as a union of a few spheres: what LIGGGHTS calls a multisphere.
#pragma once

#include <vector>

#include "coupler/mesh/triangle_mesh.hpp"

namespace dipper {

struct Sphere {
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  double radius_m = 0;
};

/// `count` spheres whose union covers the solid best: smallest symmetric difference in volume,
/// searched greedily and then by hill climbing on a grid, with the union's volume matched to the
/// solid's. No radius is below a fifth of the volume-equivalent diameter: small spheres cost
/// neighbours and add corners that are not there. Deterministic. Throws std::invalid_argument when
/// the mesh is not sound (check_mesh).
std::vector<Sphere> fit_spheres(const TriangleMesh& mesh, int count);

/// Volume [m3] of the union, on a grid of `cells` across its longest side; error about 1/cells^2.
double union_volume(const std::vector<Sphere>& spheres, int cells = 160);

/// Volume [m3] inside exactly one of solid and union, by the volume of the solid.
double symmetric_difference(const TriangleMesh& mesh, const std::vector<Sphere>& spheres);

}  // namespace dipper
