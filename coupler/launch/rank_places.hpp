// Where mpirun would put the ranks, found out before anything of a run is started.
#pragma once

#include <string>
#include <vector>

#include "coupler/launch/mpirun.hpp"

namespace dipper::launch {

/// Words of a text, quoted as for a shell; a hostfile's path is made absolute. Throws InputError
/// that names --mpirun for quotes that do not match and a hostfile that cannot be read.
std::vector<std::string> mpirun_options(const std::string& text);

/// A rank's answer to where it is.
struct RankPlace {
  std::string host, network;  ///< common/host_identity.hpp
};

/// What `program --hosts`, of which rank 0 prints report_place of each rank, has written to a file.
/// In the order of ranks; empty where a rank is missing.
std::vector<RankPlace> read_places(const std::string& said, int ranks);

/// Without hosts and files of hosts: for ranks that are all on this host anyway.
std::vector<std::string> without_hosts(const std::vector<std::string>& options);

struct PlacedRanks {
  MpiPlaces places;
  std::string hosts;  ///< "h1 (2 ranks), h2 (2 ranks)"
};

/// Starts `program --hosts` on all ranks where there may be other hosts than this one or where the
/// user has options for mpirun; else nothing is started, and all ranks are here. Throws InputError
/// that names --mpirun, with mpirun's own words, when the ranks do not come together in two
/// minutes, and when rank 0 is not on this host: it must be beside the launcher. Throws
/// Interrupted.
PlacedRanks place_ranks(int ranks, const std::vector<std::string>& options,
                        const std::string& program);

}  // namespace dipper::launch
