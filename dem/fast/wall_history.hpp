// Contact history of walls, for the rock near them only.
#pragma once

namespace dipper::dem {

/// Makes LIGGGHTS use the definitions of wall_history.cpp, with NearLists only. Call after each
/// opening of LIGGGHTS.
void use_wall_history();

}  // namespace dipper::dem
