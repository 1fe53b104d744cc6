#pragma once

namespace dipper {

constexpr double kGravity_m_s2 = 9.81;  ///< along W's -z; as in the decks of dem_in/

}  // namespace dipper
