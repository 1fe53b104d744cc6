// Makes the cohesion model `moist` known to LIGGGHTS.
#pragma once

namespace dipper::dem {

/// Once in a process, before a deck names it. LIGGGHTS keeps its models in tables that are open to
/// whoever has its headers; this adds one row to those of pairs and of walls.
void register_moist();

/// Where the contact history of pairs has a number that is not 0 for bonded ones; -1 when no deck
/// has named the model.
int bond_history_offset();

}  // namespace dipper::dem
