// Where LIGGGHTS's errors go on each rank.
#pragma once

namespace LAMMPS_NS {
class LAMMPS;
}

namespace dipper::dem {

/// Makes the error of any rank reach the user. With `-screen FILE` LIGGGHTS opens FILE on rank 0
/// alone: an error of another rank (Error::one) would be printed nowhere, and a poor mesh, of
/// which each rank prints its part, would crash that rank. Other ranks print to stdout. Each
/// line is flushed at once, since MPI_Abort drops what is in buffers. Call it
/// before the deck is read.
void show_errors_of_all_ranks(LAMMPS_NS::LAMMPS& lammps);

}  // namespace dipper::dem
