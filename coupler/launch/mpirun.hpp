// How the ranks of the rock side are started.
#pragma once

#include <string>
#include <vector>

namespace dipper::launch {

/// What mpirun is told besides how many ranks of which program (rank_places.hpp finds it out).
struct MpiPlaces {
  std::vector<std::string> options;  ///< the user's own
  bool several_hosts = false;        ///< not all ranks are on this one
  double part_here = 1;              ///< of the ranks
};

/// "mpirun -np N ..." for a program. On this host alone: more ranks than cores are allowed, idle
/// ranks then yield, and nothing is asked of other hosts or of a batch system, since the run may be
/// in a network of its own. Over several hosts Open MPI's own defaults hold, but a host that is
/// gone is noticed within half a minute. What the user's options set goes before all of that.
std::vector<std::string> mpirun(int ranks, std::vector<std::string> program,
                                const MpiPlaces& places = {});

}  // namespace dipper::launch
