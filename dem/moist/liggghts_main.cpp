// dipper-liggghts: the `liggghts` program with the cohesion model `moist` and this program's time
// loop. Takes the same arguments.
#include <input.h>
#include <lammps.h>
#include <mpi.h>

#include "dem/fast/rock_loop.hpp"
#include "dem/moist/register_moist.hpp"

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  dipper::dem::register_moist();
  {
    LAMMPS_NS::LAMMPS lammps(argc, argv, MPI_COMM_WORLD);
    dipper::dem::speed_up(lammps);
    lammps.input->file();
  }
  MPI_Finalize();
}
