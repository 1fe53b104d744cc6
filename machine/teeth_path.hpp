// The path of the dipper's teeth in the plane of the boom.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

namespace dipper::machine {

using Eigen::Vector2d;

/// Points in the plane of the boom: x out from the swing axis, z up from the ground, m.
using TeethPath = std::vector<Vector2d>;

/// The clamped uniform cubic B-spline of a control polygon, as points at equal steps of its length.
TeethPath spline(const TeethPath& polygon);

/// A smooth curve through the points that does not overshoot them in x or z: for each point but the
/// first the path to it, as points at equal steps of its length. No point may repeat the one
/// before.
std::vector<TeethPath> legs_through(const TeethPath& points);

/// Along the line through the points, m.
double length(const TeethPath& path);

/// The point at a share 0 ... 1 of the path along points at equal steps.
Vector2d at_fraction(const TeethPath& path, double share);

/// z of a surface with rising x, straight between its points and flat beyond its ends, m.
double height(const TeethPath& face, double x);

/// One dig: the path of the teeth through a face.
struct Cut {
  Vector2d start = Vector2d::Zero();  ///< in front of the toe, m: the floor's begin
  std::optional<Vector2d> begin;      ///< of the teeth's way, over the floor; none: `start`
  double depth_m = 0;                 ///< below the face's surface, square to it
  double floor_rise = 0;  ///< dz/dx of the floor that teeth and heel keep to, from the start
  double exit_z_m = 0;    ///< height at which they leave the face, at the latest
  double smooth_m = 0;    ///< over which the surface is averaged
};

/// The control polygon of a dig: from the start out along the floor to where the surface less the
/// depth is higher, up along that, and, where the crowd is all out, up on the circle about the
/// saddle block, to the exit. It never goes down, and rises where the heel would come below the
/// floor: a heel that goes down onto rock which the teeth have passed over jams it against the
/// ground and lifts the dipper off its ropes.
///
/// \param face  the surface, x rising; flat beyond its ends
/// \param saddle  the saddle block's pivot
/// \param reach_m  from there to the teeth with the crowd all out
/// \param heel  position of the dipper's heel with the teeth at a point
/// Throws std::invalid_argument when the face has no point within reach.
TeethPath cut_path(const TeethPath& face, const Cut& cut, const Vector2d& saddle, double reach_m,
                   const std::function<Vector2d(const Vector2d&)>& heel);

}  // namespace dipper::machine
