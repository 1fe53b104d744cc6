// Checks the number of ranks that were started.
#pragma once

namespace dipper::dem {

/// Throws std::runtime_error, naming the mpirun on the path, when MPI_COMM_WORLD has another size.
/// The mpirun of another MPI starts that many programs, each of which is rank 0 of 1: each would do
/// the whole run, in the same folder. Every program checks this before it writes anything.
void check_rank_count(int asked);

}  // namespace dipper::dem
