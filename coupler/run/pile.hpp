#pragma once

#include <filesystem>

#include "common/reporter.hpp"
#include "coupler/case/case.hpp"
#include "coupler/launch/mpirun.hpp"

namespace dipper::run {

/// A settled pile for the case: the LIGGGHTS restart file from which the run starts.
struct Pile {
  std::filesystem::path restart;
  bool cached = false;  ///< found in the cache
  double wall_s = 0;    ///< settling time, 0 when cached
};

/// Finds the case's pile in the cache, or settles it (dem_in/settle.in under the plain LIGGGHTS
/// binary) and stores it. The key is a hash of everything that the pile depends on. Several runs
/// may do this at once, and any of them may be killed (cache_entry.hpp). \param deck  the folder
/// that write_deck filled. \param logs  folder of LIGGGHTS's output. \param places  hosts of the
/// ranks that settle it. Says what it waits for, and how far LIGGGHTS is. Throws
/// std::runtime_error with LIGGGHTS's own message.
Pile settled_pile(const cases::Case& c, const std::filesystem::path& deck,
                  const std::filesystem::path& logs, const launch::MpiPlaces& places,
                  Reporter& reporter);

}  // namespace dipper::run
