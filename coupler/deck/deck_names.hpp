// Names that the input scripts use themselves. A body or a rock template of the same name would
// replace theirs, in LIGGGHTS without a message.
#pragma once

#include <string>

namespace dipper::deck {

/// True where the scripts (dem_in/*.in, and what write_deck writes) have a fix, a dump or a group
/// of this name, or a variable NAME_x, NAME_y, NAME_z or NAME_mesh, as a body has.
bool is_deck_name(const std::string& name);

}  // namespace dipper::deck
