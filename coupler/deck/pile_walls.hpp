// The frictionless walls that hold the bench.
#pragma once

#include "common/mesh/triangle_mesh.hpp"
#include "coupler/case/case.hpp"

namespace dipper::deck {

/// While the rock is poured and settles: two sides and the rear up to the pour's top, and the sheet
/// in front of the pour, which rises from the toe. Open surfaces.
mesh::TriangleMesh funnel_walls(const cases::Case& c);

/// For the dig: sides and rear only a little higher than the bench, so that the loaded dipper
/// swings over them.
mesh::TriangleMesh bench_walls(const cases::Case& c);

}  // namespace dipper::deck
