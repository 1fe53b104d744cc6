// The mass of rock inside a box.
#pragma once

#include <vector>

#include "common/box.hpp"
#include "common/sphere.hpp"

namespace dipper::analysis::rock {

/// Mass [kg] of the parts of the balls that lie in `box`, on a grid of cubes of `cell_m`: of balls
/// across a face only the part inside counts, and where balls of one rock overlap the volume counts
/// once. `density_kg_m3` is each ball's: for a rock of several balls, its mass divided by the
/// volume of their union. Error about (cell side / box side)^2. Throws std::invalid_argument for
/// lists of different lengths, an empty box, a cell that is not > 0.
double mass_inside(const std::vector<Sphere>& balls, const std::vector<double>& density_kg_m3,
                   const Box& box, double cell_m);

}  // namespace dipper::analysis::rock
