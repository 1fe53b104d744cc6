#pragma once

namespace dipper {

constexpr double kGravity_m_s2 = 9.81;  ///< along W's -z; as the decks in dem_in/ have it

}  // namespace dipper
