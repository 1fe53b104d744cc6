// The frictionless walls that hold the bench.
#pragma once

#include "coupler/case/case.hpp"
#include "coupler/mesh/triangle_mesh.hpp"

namespace dipper {

/// While the rock is poured and settles: two sides and the rear up to the pour's top, and the sheet
/// in front of the pour, which rises from the toe. Open surfaces.
TriangleMesh funnel_walls(const Case& c);

/// For the dig: sides and rear only a little higher than the bench, so that the dipper's load
/// swings out over them.
TriangleMesh bench_walls(const Case& c);

}  // namespace dipper
