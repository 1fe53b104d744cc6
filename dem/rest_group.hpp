#pragma once

namespace dipper::dem {

/// The LIGGGHTS group of the spheres that are held. What two of them press on each other with does
/// not change, so the loop over contacts leaves it out; who holds them makes up for it.
inline constexpr const char* kRestGroup = "at_rest";

}  // namespace dipper::dem
