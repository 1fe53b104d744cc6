// The kinds of rock in a case: each class in each of its shapes.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "common/sphere.hpp"
#include "coupler/case/case.hpp"
#include "coupler/deck/rock_shape.hpp"

namespace dipper::deck {

/// One template of rocks.in.
struct RockKind {
  std::string name;             ///< the template's
  double mass_kg = 0;           ///< of a rock
  double mass_fraction = 0;     ///< of all rock
  std::vector<Sphere> spheres;  ///< about the centre of mass, in the shape's frame
  double reach_m = 0;           ///< of the farthest sphere's far side
};

/// The name of the template of a class's rocks of one shape.
std::string kind_name(const cases::SizeClass& size, const std::string& shape);

/// In the order of rocks.in. `shapes` holds every shape of the case but `sphere`.
std::vector<RockKind> rock_kinds(const cases::Case& c,
                                 const std::map<std::string, RockShape>& shapes);

double largest_reach_m(const std::vector<RockKind>& kinds);

}  // namespace dipper::deck
