// Orders the rock in memory as it lies in space.
#pragma once

namespace LAMMPS_NS {
class FixMultisphere;
class LAMMPS;
}  // namespace LAMMPS_NS

namespace dipper::dem {

/// Puts spheres and bodies of this rank in the order of a curve through space (Morton 1966): those
/// of one body one after the other, near what they touch, and all that rests (kRestGroup) behind
/// what moves. LIGGGHTS's own sort (`atom_modify sort`) tears bodies apart and leaves them as they
/// were poured. To be called when spheres have gone to their ranks and none has ghosts.
void order_rock(LAMMPS_NS::LAMMPS& lmp, LAMMPS_NS::FixMultisphere& bodies);

}  // namespace dipper::dem
