// What the rock was weighed with.
#pragma once

namespace dipper {

constexpr double kGravity_m_s2 = 9.81;  ///< as dem_in/dig.in has it

}  // namespace dipper
