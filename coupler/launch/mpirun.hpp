// How the ranks of the rock side are started.
#pragma once

#include <string>
#include <vector>

namespace dipper::launch {

/// mpirun's input besides program and number of ranks (found by rank_places.hpp).
struct MpiPlaces {
  std::vector<std::string> options;  ///< the user's own
  bool several_hosts = false;        ///< some ranks are on other hosts
  double part_here = 1;              ///< share of the ranks on this host
};

/// "mpirun -np N ..." for a program. On this host alone: more ranks than cores are allowed, idle
/// ranks then yield, and no other host or batch system is contacted, since the run may be in a
/// network of its own. Over several hosts Open MPI's defaults hold, but a host that fails is
/// noticed within half a minute. The user's options override all of that.
std::vector<std::string> mpirun(int ranks, std::vector<std::string> program,
                                const MpiPlaces& places = {});

/// Of the mpirun on the PATH, where it is none or not Open MPI's: a sentence with its place and the
/// advice; "" where it is. Asks it for its version, and waits 5 s at most.
std::string mpirun_fault();

}  // namespace dipper::launch
