// Teeth that have worn down.
#pragma once

#include "common/mesh/triangle_mesh.hpp"

namespace dipper::mesh {

/// The mesh (frame B: x to the lip) with its teeth cut off `wear` [m] behind its foremost point,
/// across x. No vertex is added: each one in front of the cut slides to it along the edge between
/// two planes of the tooth that leads behind the cut, so that a wedge keeps its sides, but is
/// shorter and blunt. Teeth that end behind the cut stay as they are. Throws std::invalid_argument,
/// with the largest wear that is allowed, when the cut would leave less than a tenth of an edge or
/// passes a vertex without one such edge; and when `wear` is not positive.
TriangleMesh wear_teeth(const TriangleMesh& dipper, double wear);

}  // namespace dipper::mesh
