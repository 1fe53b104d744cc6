// Where mpirun would put the ranks, determined before a run starts anything.
#pragma once

#include <string>
#include <vector>

#include "coupler/launch/mpirun.hpp"

namespace dipper::launch {

/// Words of a text, quoted as for a shell; a hostfile's path is made absolute. Throws InputError
/// that names --mpirun for quotes that do not match and a hostfile that cannot be read.
std::vector<std::string> mpirun_options(const std::string& text);

/// The place that a rank reports.
struct RankPlace {
  std::string host, network;  ///< common/host_identity.hpp
};

/// Reads the output of `program --hosts`, in which rank 0 prints report_place of each rank. In the
/// order of ranks; empty when a rank is missing.
std::vector<RankPlace> read_places(const std::string& said, int ranks);

/// The options without hosts and hostfiles: for ranks that are all on this host.
std::vector<std::string> without_hosts(const std::vector<std::string>& options);

struct PlacedRanks {
  MpiPlaces places;
  std::string hosts;  ///< "h1 (2 ranks), h2 (2 ranks)"
};

/// Starts `program --hosts` on all ranks if there may be other hosts, or if the user gave options
/// for mpirun; else starts nothing: all ranks are on this host. Throws InputError that names
/// --mpirun, with mpirun's own message, when the ranks do not start within two minutes, and when
/// rank 0 is not on this host, where the launcher needs it. Throws Interrupted.
PlacedRanks place_ranks(int ranks, const std::vector<std::string>& options,
                        const std::string& program);

}  // namespace dipper::launch
