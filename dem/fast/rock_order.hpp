// Sorts the rock in memory by its place in space.
#pragma once

namespace LAMMPS_NS {
class FixMultisphere;
class LAMMPS;
}  // namespace LAMMPS_NS

namespace dipper::dem {

/// Sorts spheres and bodies of this rank along a curve through space (Morton 1966): those of one
/// body together, near the spheres they touch, and resting rock (kRestGroup) behind moving rock.
/// LIGGGHTS's own sort (`atom_modify sort`) separates the spheres of a body and leaves bodies in
/// the order of pouring. Call when spheres are on their ranks and there are no ghosts.
void order_rock(LAMMPS_NS::LAMMPS& lmp, LAMMPS_NS::FixMultisphere& bodies);

}  // namespace dipper::dem
