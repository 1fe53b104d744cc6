// Bonds the rock of a crust.
#pragma once

#include <lammps.h>

#include "dem/rock_setup.hpp"

namespace dipper::dem {

/// Makes every contact of two spheres in the zone a bond of the cohesion model `muck`. After a
/// set-up
/// (`run 0`) and before another, which computes the forces anew. Collective over the ranks. Throws
/// std::runtime_error if the deck has no property/atom crust_zone.
void form_crust(LAMMPS_NS::LAMMPS& lmp, const CrustZone& zone);

/// Bonds of this rank that hold; one to a rock of another rank counts half on each.
double count_bonds(const LAMMPS_NS::LAMMPS& lmp);

}  // namespace dipper::dem
