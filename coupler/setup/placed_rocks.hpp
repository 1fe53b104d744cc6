// Rocks and where they lie, as place-rocks (dem/) takes them into LIGGGHTS and gives them back.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/frames.hpp"

namespace dipper::setup {

/// A rock R of the kind whose template in the deck's rocks.in is named so. R's origin is the rock's
/// centre of mass, its axes are the template's.
struct PlacedRock {
  std::string kind;
  Pose X_WR;
};

/// CSV: kind, x_m, y_m, z_m, qw, qx, qy, qz; to the bit. Throws std::runtime_error naming the file.
void write_placed_rocks(const std::filesystem::path& file, const std::vector<PlacedRock>& rocks);

/// The same back. Throws InputError for everything wrong in it.
std::vector<PlacedRock> read_placed_rocks(const std::filesystem::path& file);

}  // namespace dipper::setup
