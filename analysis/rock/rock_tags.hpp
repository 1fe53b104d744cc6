// The rock to which a sphere of a dump belongs.
#pragma once

#include <filesystem>
#include <unordered_map>
#include <vector>

#include "analysis/rock/rocks.hpp"
#include "analysis/rock/zones.hpp"

namespace dipper::analysis::rock {

/// A rock's properties, as stored with each of its spheres.
struct RockTag {
  double size_m = 0;  ///< diameter of a sphere of the same volume; 0: its density is not known
  int shape = 0;      ///< 0: a sphere; from 1: index of the clump shape
  bool in_dipper = false;
};

/// The radii of a clump's spheres, largest first, relative to the largest.
using ShapeRadii = std::vector<double>;

/// From the *.spheres files of a deck, by their names. Throws InputError naming file and line.
std::vector<ShapeRadii> read_shapes(const std::filesystem::path& deck);

/// The key of a sphere's rock, as in Fragment. `clump` -1: the sphere is a rock.
inline std::int64_t rock_key(std::int64_t id, std::int64_t clump) {
  return clump >= 0 ? -1 - clump : id;
}

/// Every rock of a frame by its key. A clump's shape is the one with the same number of spheres and
/// the nearest radii; 0 when `shapes` has none. `X_WB` is the dipper's pose in the frame. Throws as
/// for_each_fragment does.
std::unordered_map<std::int64_t, RockTag> tag_rocks(const io::DumpFrame& frame,
                                                    const ClumpMasses& clumps,
                                                    const std::vector<ShapeRadii>& shapes,
                                                    const LoadRegions& regions, const Pose& X_WB);

}  // namespace dipper::analysis::rock
