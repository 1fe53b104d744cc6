// place-rocks put ROCKS.csv RESTART -in DECK ...   puts rocks into the box the deck makes
// place-rocks get ROCKS.csv -in DECK ...           writes the poses of the deck's rocks
//
// The further arguments are those of the program `liggghts`; the deck is dem_in/place.in.
// ROCKS.csv: coupler/setup/placed_rocks.hpp. On one rank.
#include <input.h>
#include <lammps.h>
#include <mpi.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include "dem/error_screen.hpp"
#include "dem/moist/register_moist.hpp"
#include "dem/place_rocks.hpp"

namespace dipper::dem {
namespace {

[[noreturn]] void fail(const std::exception& e) {
  std::fprintf(stderr, "place-rocks: %s\n", e.what());
  MPI_Abort(MPI_COMM_WORLD, 1);
  std::abort();
}

void run(const std::vector<std::string>& words, std::vector<char*> liggghts_words) {
  LAMMPS_NS::LAMMPS lammps(static_cast<int>(liggghts_words.size()), liggghts_words.data(),
                           MPI_COMM_WORLD);
  show_errors_of_all_ranks(lammps);
  lammps.input->file();
  try {
    if (words[0] == "get") {
      setup::write_placed_rocks(words[1], placed_rocks(lammps));
      // LIGGGHTS crashes at its end after reading a restart file, unless a run was set up.
      lammps.input->one("run 0");
    } else {
      place_rocks(lammps, setup::read_placed_rocks(words[1]));
      lammps.input->one(("write_restart " + words[2]).c_str());
    }
  } catch (const std::exception& e) {
    fail(e);  // before LIGGGHTS's destructor, which would crash
  }
}

}  // namespace
}  // namespace dipper::dem

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  int ranks = 0;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  std::vector<std::string> words(argv + 1, argv + argc);
  const std::size_t own = !words.empty() && words[0] == "put" ? 3 : 2;
  if (ranks != 1 || words.size() <= own || (words[0] != "put" && words[0] != "get")) {
    std::fprintf(stderr,
                 "usage, on one rank: place-rocks put ROCKS.csv RESTART -in DECK ...\n"
                 "                    place-rocks get ROCKS.csv -in DECK ...\n");
    MPI_Abort(MPI_COMM_WORLD, 2);
  }
  std::vector<char*> liggghts_words = {argv[0]};
  liggghts_words.insert(liggghts_words.end(), argv + 1 + own, argv + argc);
  dipper::dem::register_moist();
  dipper::dem::run(words, liggghts_words);
  MPI_Finalize();
}
