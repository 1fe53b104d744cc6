// The rock in front of the teeth, and how it resists: Dombrovskij's formula.
#pragma once

#include "common/height_map.hpp"

namespace dipper::machine {

/// Of blasted rock at true size, force by area of the cut (docs/dry_run.md).
inline constexpr double kSpecificResistance_Pa = 0.38e6;

struct CutAhead {
  double depth_m = 0;  ///< of the teeth under the surface in front of them, square to that; the
                       ///< mean over their width, as single rocks stand out of a face
  bool meets = false;  ///< the teeth go into rock: it resists by depth, width and a specific
                       ///< resistance, along the floor from the teeth to the heel
};

/// \param left_B, right_B  the outer teeth's tips
/// \param v_W  m/s, of the tips
CutAhead cut_ahead(const HeightMap& bench, const Pose& X_WB, const Vector3d& left_B,
                   const Vector3d& right_B, const Vector3d& v_W);

}  // namespace dipper::machine
