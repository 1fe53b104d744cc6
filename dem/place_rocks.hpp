// Puts rocks into LIGGGHTS where they are to lie, and tells where they are.
#pragma once

#include <vector>

#include "coupler/setup/placed_rocks.hpp"

namespace LAMMPS_NS {
class LAMMPS;
}

namespace dipper::dem {

/// Adds the rocks, at rest, from the deck's templates (`fix particletemplate/sphere` and
/// `.../multisphere`), as `fix insert/pack` does with those it finds a place for; overlaps are not
/// looked for. On one rank, once the deck has its box, templates and `fix multisphere`. Throws
/// std::runtime_error for a kind that has no template.
void place_rocks(LAMMPS_NS::LAMMPS& lmp, const std::vector<setup::PlacedRock>& rocks);

/// Every rock there is, on one rank: single spheres, then multispheres, each by its template.
/// A single sphere's turn is none. Throws std::runtime_error for a rock of no template.
std::vector<setup::PlacedRock> placed_rocks(LAMMPS_NS::LAMMPS& lmp);

}  // namespace dipper::dem
