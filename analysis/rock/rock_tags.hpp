// What a sphere of a dump is a part of.
#pragma once

#include <filesystem>
#include <unordered_map>
#include <vector>

#include "analysis/rock/rocks.hpp"
#include "analysis/rock/zones.hpp"

namespace dipper::analysis::rock {

/// A rock as its spheres can carry it.
struct RockTag {
  double size_m = 0;  ///< of a sphere of its volume; 0: its density is not known
  int shape = 0;      ///< 0: a sphere; from 1: of the clump shapes, in their order
  bool in_dipper = false;
};

/// The radii of a clump's spheres, largest first, as shares of the largest.
using ShapeRadii = std::vector<double>;

/// Of the *.spheres files in a deck, by their names. Throws InputError naming file and line.
std::vector<ShapeRadii> read_shapes(const std::filesystem::path& deck);

/// The key of the rock that a sphere is of, as Fragment has it. `clump` -1: it is one by itself.
inline std::int64_t rock_key(std::int64_t id, std::int64_t clump) {
  return clump >= 0 ? -1 - clump : id;
}

/// Every rock of a frame by its key. A clump's shape is the one with as many spheres whose radii
/// are nearest; 0 when `shapes` has none. `X_WB` is the dipper's pose then. Throws as
/// for_each_fragment does.
std::unordered_map<std::int64_t, RockTag> tag_rocks(const io::DumpFrame& frame,
                                                    const ClumpMasses& clumps,
                                                    const std::vector<ShapeRadii>& shapes,
                                                    const LoadRegions& regions, const Pose& X_WB);

}  // namespace dipper::analysis::rock
