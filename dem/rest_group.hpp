#pragma once

// LIGGGHTS's headers count on what comes before them.
#include <lammps.h>
//
#include <group.h>

namespace dipper::dem {

/// The LIGGGHTS group of the spheres that are held. What two of them press on each other with does
/// not change, so the loop over contacts leaves it out; who holds them makes up for it.
inline constexpr const char* kRestGroup = "at_rest";

/// Its bit in a sphere's mask; 0 where nothing was ever held.
inline int rest_bit(const LAMMPS_NS::LAMMPS& lmp) {
  const int known = lmp.group->find(kRestGroup);
  return known < 0 ? 0 : lmp.group->bitmask[known];
}

}  // namespace dipper::dem
