// Registers the cohesion model `moist` with LIGGGHTS.
#pragma once

namespace dipper::dem {

/// Call once in a process, before a deck uses it. LIGGGHTS's tables of models are accessible
/// through its headers; this adds one row to those of pairs and of walls.
void register_moist();

/// Offset in the contact history of pairs of a number that is not 0 for bonded ones; -1 when no
/// deck has named the model.
int bond_history_offset();

}  // namespace dipper::dem
