// dipper-liggghts [--loop fast|liggghts] [--ranks N] ...: the `liggghts` program with the cohesion
// model `moist` and the time loop of dem/fast, or with --loop liggghts LIGGGHTS's own. With --ranks
// it ends when the number of ranks differs. Takes LIGGGHTS's arguments after these.
#include <input.h>
#include <lammps.h>
#include <mpi.h>

#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>

#include "dem/error_screen.hpp"
#include "dem/fast/rock_loop.hpp"
#include "dem/moist/register_moist.hpp"
#include "dem/rank_count.hpp"

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  bool fast = true;
  const auto take =
      [&](const char* option) {  // returns its value and removes both from the arguments
        if (argc < 3 || std::string(argv[1]) != option) return std::string();
        const std::string value = argv[2];
        argv[2] = argv[0];
        argv += 2;
        argc -= 2;
        return value;
      };
  try {
    if (const std::string loop = take("--loop"); !loop.empty()) {
      if (loop != "fast" && loop != "liggghts")
        throw std::runtime_error("--loop is '" + loop + "'; write fast or liggghts");
      fast = loop == "fast";
    }
    if (const std::string ranks = take("--ranks"); !ranks.empty())
      dipper::dem::check_rank_count(std::stoi(ranks));
  } catch (const std::exception& e) {
    std::fprintf(stderr, "dipper-liggghts: %s\n", e.what());
    MPI_Abort(MPI_COMM_WORLD, 2);
  }
  dipper::dem::register_moist();
  {
    LAMMPS_NS::LAMMPS lammps(argc, argv, MPI_COMM_WORLD);
    dipper::dem::show_errors_of_all_ranks(lammps);
    if (fast) dipper::dem::speed_up(lammps);
    lammps.input->file();
  }
  MPI_Finalize();
}
