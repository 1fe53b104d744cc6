// What makes a mesh unfit as a wall or a body.
#pragma once

#include <string>
#include <vector>

#include "coupler/mesh/triangle_mesh.hpp"

namespace dipper {

enum class MeshFaultKind { degenerate, duplicate, open_edge, flipped, crowded_edge, inverted };

struct MeshFault {
  MeshFaultKind kind;
  std::size_t facet;    ///< 1-based, in the order of the file; 0: the whole shell
  std::string message;  ///< begins with "facet N" where there is one
};

/// Every fault: facets without area, facets given twice, edges of one facet only (with their end
/// points), neighbours that disagree on the outside, edges of more than two facets, and closed
/// shells that face inwards. Several shells may share a mesh; a shell inside another must face
/// inwards (a cavity), which is not told apart from a fault by depth but by the sign of the
/// whole: only outermost shells are checked.
std::vector<MeshFault> check_mesh(const TriangleMesh& mesh);

}  // namespace dipper
