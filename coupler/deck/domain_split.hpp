// The split of the DEM box between ranks.
#pragma once

#include <array>

#include "coupler/case/case.hpp"

namespace dipper::deck {

/// Parts along x, y and z; their product is the number of ranks.
struct DomainSplit {
  std::array<int, 3> parts{1, 1, 1};
  double largest_fraction = 1;  ///< of the bench's rock, on one rank; 1/ranks is even
};

/// LIGGGHTS cuts its box into equal parts, regardless of the rock, and never moves a cut. Chosen
/// is, of all grids of `ranks` parts, the one whose fullest part holds the least of the bench, and
/// of those within kSameShare of it the one that cuts through the least rock (which neighbours
/// exchange).
DomainSplit best_split(const cases::Case& c, int ranks);

inline constexpr double kSameShare = 1.02;

}  // namespace dipper::deck
