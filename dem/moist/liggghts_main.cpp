// dipper-liggghts [--loop fast|liggghts] ...: the `liggghts` program with the cohesion model
// `moist` and the time loop of dem/fast, or, so told, LIGGGHTS's own. Takes the same arguments
// after that.
#include <input.h>
#include <lammps.h>
#include <mpi.h>

#include <cstdio>
#include <string>

#include "dem/fast/rock_loop.hpp"
#include "dem/moist/register_moist.hpp"

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  bool fast = true;
  if (argc > 1 && std::string(argv[1]) == "--loop") {
    const std::string loop = argc > 2 ? argv[2] : "";
    if (loop != "fast" && loop != "liggghts") {
      std::fprintf(stderr, "dipper-liggghts: --loop is '%s'; write fast or liggghts\n",
                   loop.c_str());
      MPI_Abort(MPI_COMM_WORLD, 2);
    }
    fast = loop == "fast";
    argv[2] = argv[0];
    argv += 2;
    argc -= 2;
  }
  dipper::dem::register_moist();
  {
    LAMMPS_NS::LAMMPS lammps(argc, argv, MPI_COMM_WORLD);
    if (fast) dipper::dem::speed_up(lammps);
    lammps.input->file();
  }
  MPI_Finalize();
}
