// A layer on the inside of a dipper: wear liners, or rock that sticks.
#pragma once

#include "common/mesh/mass_properties.hpp"
#include "common/mesh/triangle_mesh.hpp"

namespace dipper::mesh {

/// Which inner faces carry the layer.
enum class LinedFaces { all_sides, floor };

struct Lining {
  TriangleMesh mesh;     ///< the dipper with the layer on it
  MassProperties layer;  ///< of the layer alone, at density 1, in the mesh's frame
};

/// Moves the inner faces of a closed dipper mesh (frame B: z from the floor to the roof) into the
/// cavity by `thickness`. Inner faces are those inside `cavity` (grown across x by a tenth of its
/// smallest side) that face its middle and are not the ends along x: floor, roof and side
/// plates. Throws std::invalid_argument when there are none or when the layer is thicker than a
/// quarter of the cavity.
Lining line_dipper(const TriangleMesh& dipper, const Box& cavity, double thickness,
                   LinedFaces faces);

}  // namespace dipper::mesh
