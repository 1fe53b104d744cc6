// How far down the dipper can come in front of a face.
#pragma once

#include "common/height_map.hpp"
#include "machine/kinematics.hpp"
#include "machine/teeth_path.hpp"

namespace dipper::machine {

/// Distance that the dipper's floor keeps from rock on its way down, m. A rock that reaches higher
/// is pushed aside, unless it or others hold the floor over more than a quarter of its width.
inline constexpr double kApproachClear_m = 0.1;

/// Where the teeth are at the end of a way down (in the plane of the boom), or before: at the last
/// point at which the dipper's floor, from teeth to heel and over its width, is clear of the rock.
/// \param X_WBoom  on the ground below the swing axis, x along the boom
/// Throws std::domain_error as ShovelKinematics::heel, and where even the way's begin is not clear.
Vector2d approach_end(const TeethPath& way, const HeightMap& face, const Pose& X_WBoom,
                      double half_width_m, const ShovelKinematics& shovel);

}  // namespace dipper::machine
