// The parts around a truck's bed: wheels, frame, cab, in the proportions of a CAT 793.
#pragma once

#include <vector>

#include "common/box.hpp"
#include "machine/shovel_figure.hpp"

namespace dipper::machine {

/// Parts in T (x forward, z up from the ground) around a bed that fills `box` [m], by the box's
/// length, width and height.
std::vector<FigurePart> truck_figure(const Box& box);

}  // namespace dipper::machine
