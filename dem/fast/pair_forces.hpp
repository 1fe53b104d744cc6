// The decks' contact law between rocks, in one loop.
#pragma once

namespace dipper::dem {

/// Registers it with LIGGGHTS, in place of its own loop for the same `pair_style`. Call after each
/// opening of LIGGGHTS, which fills its table of styles, and before the deck.
void register_pair_forces();

}  // namespace dipper::dem
