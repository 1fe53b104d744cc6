#include "dem/rank_count.hpp"

#include <fmt/core.h>
#include <mpi.h>

#include <stdexcept>

#include "common/installation.hpp"

namespace dipper::dem {

void check_rank_count(int asked) {
  int ranks = 0;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  if (ranks == asked) return;
  throw std::runtime_error(fmt::format(
      "{} rank{} came up where {} belong: {} is of another MPI than this program, which takes Open "
      "MPI's, or a script that changes -np; put Open MPI's folder first in PATH",
      ranks, ranks == 1 ? "" : "s", asked, found_on_path("mpirun")));
}

}  // namespace dipper::dem
