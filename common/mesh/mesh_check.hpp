// Faults that make a mesh unfit as a wall or a body.
#pragma once

#include <string>
#include <vector>

#include "common/mesh/triangle_mesh.hpp"

namespace dipper::mesh {

/// One fault, of one facet.
struct MeshFault {
  enum class Kind { degenerate, duplicate, open_edge, crowded_edge, flipped, inverted };
  Kind kind;
  std::size_t facet;  ///< 1-based, in the order of the file
  std::string message;
};

/// Every fault: facets without area, facets given twice, edges of one facet only (with their end
/// points) or of an odd number, facets whose neighbours disagree with them on the outside, and
/// closed shells that face inwards. Several shells are fine; a cavity is not (nothing reaches it).
std::vector<MeshFault> check_mesh(const TriangleMesh& mesh);

/// The smallest angle of a facet (0-based) [rad].
double smallest_angle(const TriangleMesh& mesh, std::size_t facet);

/// Facets with an angle below `least_angle` [rad], of those that have an area.
std::vector<MeshFault> check_angles(const TriangleMesh& mesh, double least_angle);

}  // namespace dipper::mesh
