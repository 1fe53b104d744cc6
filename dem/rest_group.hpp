#pragma once

// LIGGGHTS's headers depend on their order.
#include <lammps.h>
//
#include <group.h>

namespace dipper::dem {

/// The LIGGGHTS group of the spheres that are held. The force between two of them does
/// not change, so the loop over contacts skips it; HoldRock compensates.
inline constexpr const char* kRestGroup = "at_rest";

/// Its bit in a sphere's mask; 0 when nothing was ever held.
inline int rest_bit(const LAMMPS_NS::LAMMPS& lmp) {
  const int known = lmp.group->find(kRestGroup);
  return known < 0 ? 0 : lmp.group->bitmask[known];
}

}  // namespace dipper::dem
