// Rocks and their poses, as place-rocks (dem/) puts them into LIGGGHTS and reads them back.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/frames.hpp"

namespace dipper::setup {

/// A rock R of the kind with this template name in the deck's rocks.in. R's origin is the rock's
/// centre of mass; its axes are those of the template.
struct PlacedRock {
  std::string kind;
  Pose X_WR;
};

/// CSV: kind, x_m, y_m, z_m, qw, qx, qy, qz; exact. Throws std::runtime_error naming the file.
void write_placed_rocks(const std::filesystem::path& file, const std::vector<PlacedRock>& rocks);

/// Reads the same file. Throws InputError with all faults in it.
std::vector<PlacedRock> read_placed_rocks(const std::filesystem::path& file);

}  // namespace dipper::setup
