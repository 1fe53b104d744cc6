// A solid as a union of a few spheres: a multisphere of LIGGGHTS.
#pragma once

#include <vector>

#include "common/mesh/triangle_mesh.hpp"
#include "common/sphere.hpp"

namespace dipper::deck {

/// `count` spheres whose union fits the solid best: least symmetric difference in volume, then
/// scaled to the solid's own volume. The volume in just one of union U and solid S changes with the
/// union's surface alone (Hadamard): dE/dr = sum of dA over the exposed part of a sphere's surface,
/// counted + outside S and - inside it; dE/dc the same with the normal. Descent along it (Adam;
/// Kingma and Ba 2015) from many starts (k-means of the inside), the best one kept. No radius is
/// below a share of the volume-equivalent diameter (least_radius): small spheres add neighbours
/// to compute, and corners that the solid does not have. Deterministic. Throws
/// std::invalid_argument when the mesh is not sound (check_mesh).
std::vector<Sphere> fit_spheres(const mesh::TriangleMesh& mesh, int count);

/// Of the volume-equivalent diameter: 0.2 for six spheres and fewer, falling with the cube root of
/// their number.
double least_radius(int count);

/// Volume [m3] of the union, on a grid of `cells` across its longest side; error about 1/cells^2.
double union_volume(const std::vector<Sphere>& spheres, int cells = 160);

/// Volume [m3] inside exactly one of solid and union, by the volume of the solid.
double symmetric_difference(const mesh::TriangleMesh& mesh, const std::vector<Sphere>& spheres);

}  // namespace dipper::deck
