// The frictionless walls that hold the bench.
#pragma once

#include <map>
#include <string>

#include "common/mesh/triangle_mesh.hpp"
#include "coupler/case/case.hpp"

namespace dipper::deck {

/// While the rock is poured and settles: two sides and the rear up to the pour's top, and the sheet
/// in front of the pour, which rises from the toe. Open surfaces.
mesh::TriangleMesh funnel_walls(const cases::Case& c);

/// While a bench of bricks relaxes: left, right and rear, in their final places. They begin the
/// reach of a rock further out, and each is as much longer, so that no gap opens between them.
std::map<std::string, mesh::TriangleMesh> closing_walls(const cases::Case& c, double reach_m);

/// For the dig: sides and rear only a little higher than the bench, so that the loaded dipper
/// swings over them.
mesh::TriangleMesh bench_walls(const cases::Case& c);

}  // namespace dipper::deck
