// The files a LIGGGHTS run of a case reads (besides dem_in/*.in and the wall meshes).
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "coupler/case/case.hpp"
#include "coupler/deck/rock_shape.hpp"

namespace dipper::deck {

/// The version of dipper-liggghts and the case's dem.loop, part of the cache key of piles: it
/// changes with the order of its sums.
constexpr const char* settler(cases::RockLoop loop) {
  return loop == cases::RockLoop::fast ? "LIGGGHTS 3.8.0, loop 1" : "LIGGGHTS 3.8.0";
}

/// The number of rocks of one class in the pour.
struct ClassCount {
  std::string name;
  double rocks = 0;  ///< expected, before rounding
};
std::vector<ClassCount> rock_counts(const cases::Case& c);

/// The case's shapes by name, but for `sphere`, from the folder with NAME.yaml or NAME.stl of each.
std::map<std::string, RockShape> used_shapes(const cases::Case& c,
                                             const std::filesystem::path& folder);

/// Writes of what write_deck does what the rock is: material.in, rocks.in and NAME.spheres.
void write_rock(const cases::Case& c, const std::map<std::string, RockShape>& shapes,
                const std::filesystem::path& folder);

/// Writes into `folder` (created):
///   case.in      variables: box, step, walls, pile, truck, body meshes, ranks
///   material.in  type-pair tables (contact_table.hpp)
///   rocks.in     templates of the classes and their distribution by mass
///   NAME.spheres one per rock shape, diameter 1 m
///   funnel.stl   frictionless walls while the rock settles: sides, rear, retaining sheet
///   sides.stl    the same sides and rear cut down along the bench, for the dig
///   walls/       copies of the body and truck meshes that the case names by absolute paths;
///                relative ones start at LIGGGHTS's working folder
/// `shapes` is the folder with NAME.yaml or NAME.stl of every shape (shape_library.hpp). The folder
/// can be moved. Throws std::invalid_argument naming the key for a case without a deck
/// (a body other than dipper and door, a class with less than one rock), std::runtime_error for
/// files.
void write_deck(const cases::Case& c, const std::filesystem::path& shapes,
                const std::filesystem::path& folder);

}  // namespace dipper::deck
