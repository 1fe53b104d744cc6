// What walls remember of the rock that touches them, kept for the rock near them only.
#pragma once

namespace dipper::dem {

/// Has its definitions in the program (wall_history.cpp), which count for LIGGGHTS with NearLists
/// alone. After each opening of LIGGGHTS.
void use_wall_history();

}  // namespace dipper::dem
