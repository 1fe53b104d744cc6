// Puts rocks into LIGGGHTS at given poses, and reads the poses of its rocks.
#pragma once

#include <vector>

#include "coupler/setup/placed_rocks.hpp"

namespace LAMMPS_NS {
class LAMMPS;
}

namespace dipper::dem {

/// Adds the rocks, at rest, from the deck's templates (`fix particletemplate/sphere` and
/// `.../multisphere`), as `fix insert/pack` does, without its search for overlaps. On one rank,
/// once the deck has its box, templates and `fix multisphere`. Throws std::runtime_error for a kind
/// that has no template.
void place_rocks(LAMMPS_NS::LAMMPS& lmp, const std::vector<setup::PlacedRock>& rocks);

/// All rocks, on one rank: single spheres, then multispheres, each with its template. A single
/// sphere has no rotation. Throws std::runtime_error for a rock of no template.
std::vector<setup::PlacedRock> placed_rocks(LAMMPS_NS::LAMMPS& lmp);

}  // namespace dipper::dem
