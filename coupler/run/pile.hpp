#pragma once

#include <filesystem>

#include "coupler/case/case.hpp"
#include "coupler/launch/mpirun.hpp"

namespace dipper::run {

/// A settled bench for the case: the LIGGGHTS restart file to dig in.
struct Pile {
  std::filesystem::path restart;
  bool cached = false;  ///< it was there already
  double wall_s = 0;    ///< settling time, 0 when cached
};

/// Finds the case's bench in the cache, or settles it (dem_in/settle.in under the plain LIGGGHTS
/// binary) and puts it there. The key is a hash of everything the bench depends on. Two runs may do
/// this at once and either may be killed (cache_entry.hpp).
/// \param deck  the folder write_deck filled
/// \param logs  where LIGGGHTS's output goes
/// \param places  of the ranks that settle it
/// Throws std::runtime_error with LIGGGHTS's own message.
Pile settled_pile(const cases::Case& c, const std::filesystem::path& deck,
                  const std::filesystem::path& logs, const launch::MpiPlaces& places);

}  // namespace dipper::run
