// Rows from every rank to every rank.
#pragma once

#include <mpi.h>

#include <cstddef>
#include <type_traits>
#include <vector>

namespace dipper::dem {

/// The rows of all ranks, rank by rank. Collective; 2 GB at most.
template <class Row>
std::vector<Row> of_all_ranks(const std::vector<Row>& mine, MPI_Comm comm) {
  static_assert(std::is_trivially_copyable_v<Row>);
  int ranks = 1;
  MPI_Comm_size(comm, &ranks);
  const int bytes = static_cast<int>(mine.size() * sizeof(Row));
  std::vector<int> counts(static_cast<std::size_t>(ranks)), offsets(counts.size(), 0);
  MPI_Allgather(&bytes, 1, MPI_INT, counts.data(), 1, MPI_INT, comm);
  for (std::size_t r = 1; r < counts.size(); ++r) offsets[r] = offsets[r - 1] + counts[r - 1];
  std::vector<Row> all(static_cast<std::size_t>(offsets.back() + counts.back()) / sizeof(Row));
  MPI_Allgatherv(mine.data(), bytes, MPI_BYTE, all.data(), counts.data(), offsets.data(), MPI_BYTE,
                 comm);
  return all;
}

}  // namespace dipper::dem
