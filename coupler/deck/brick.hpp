// A bench of bricks: rock that settled once, laid again and again, in place of a pour as large as
// the bench.
//
// A brick is a block of the case's rock that has settled on the ground, as high as the bench, in a
// box that repeats along x and y. So it fits itself on every side, and has no seam there: what is
// laid is one endless bed. A bench is cut out of that bed at a place and a turn about the vertical
// that its seed draws, and between several bricks of the same rock. A clump's mirror image would be
// another shape, so nothing is mirrored. The turn is never along the bench, so that what repeats
// does not stand in rows along its face.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "coupler/case/case.hpp"
#include "coupler/deck/rock_kinds.hpp"
#include "coupler/deck/rock_shape.hpp"
#include "coupler/setup/placed_rocks.hpp"

namespace dipper::deck {

/// Counts up when the same case's brick or bench comes out differently.
constexpr int kBrickVersion = 1;

/// What a brick depends on besides the rock and its contacts.
struct BrickShape {
  int number = 0;            ///< of kBricks of the same rock
  double side_m = 0;         ///< along x and y: kSideInRocks of the largest rock
  double height_m = 0;       ///< at least, once settled: the bench's, in whole metres
  double pour_height_m = 0;  ///< of the loose rock that settles
  double mass_kg = 0;
};

/// Bricks of one rock: seeds that have a brick in common have other cuts through it.
constexpr int kBricks = 4;
constexpr double kSideInRocks = 8;

BrickShape brick_shape(const cases::Case& c);

/// Writes what dem_in/place.in and brick.in read: case.in, material.in, rocks.in and NAME.spheres,
/// of rock whose random choices are the brick's.
void write_brick_deck(const cases::Case& c, const std::map<std::string, RockShape>& shapes,
                      const std::filesystem::path& folder);

/// The rock of a brick, hung loosely over the ground: no two spheres overlap, not across the box's
/// sides either. The number of each kind is its share of the mass, to half a rock of a class. The
/// same shape and kinds give the same rock. Throws std::runtime_error when a rock finds no room.
std::vector<setup::PlacedRock> loose_brick(const std::vector<RockKind>& kinds,
                                           const BrickShape& shape);

/// How a bench lies in the bed: X_W = turn about z, then shift, of what is in the bricks.
struct BrickLay {
  double turn_rad = 0;
  Eigen::Vector2d shift_m = Eigen::Vector2d::Zero();
};
BrickLay brick_lay(std::int64_t seed, const BrickShape& shape);

/// The rocks of the bed that lie as a whole behind the toe's line, before the rear and between the
/// sides, and whose centres are not over kPourExcess times `height` at their x and y: rock sinks a
/// little as what the walls have cut off leaves room. `kinds` are those of the brick.
std::vector<setup::PlacedRock> laid_bench(
    const std::vector<setup::PlacedRock>& brick, const std::vector<RockKind>& kinds,
    const BrickShape& shape, const BrickLay& lay, const cases::Case& c,
    const std::function<double(double x_m, double y_m)>& height);

}  // namespace dipper::deck
