// The contact law of the decks between rocks, as one loop.
#pragma once

namespace dipper::dem {

/// Makes it known to LIGGGHTS, in place of its own loop for the same `pair_style`. After each
/// opening of LIGGGHTS, which fills its table of styles, and before the deck.
void register_pair_forces();

}  // namespace dipper::dem
