// The shortest path of a rope from one end over a round sheave to the other, in the sheave's plane.
#pragma once

#include <Eigen/Core>

namespace dipper::machine {

using Eigen::Vector2d;

/// The path of the rope. All vectors in the plane's axes (x, z), from the sheave's centre.
struct SheavePath {
  double length;      ///< m: straight, wrapped, straight
  double free_b;      ///< m: the straight part at end b
  double wrap;        ///< rad on the sheave, in [0, 2 pi)
  Vector2d toward_a;  ///< unit vector along the rope, from end a to where it meets the sheave
  Vector2d toward_b;  ///< the same from end b
};

/// The path of a taut rope from a over the sheave, clockwise (x to the right, z up), to b.
///
/// \param a, b ends of the rope relative to the sheave's centre, m
/// \param radius of the sheave at the rope's centre line, m
/// Throws std::domain_error if an end lies on or inside the sheave.
SheavePath sheave_path(const Vector2d& a, const Vector2d& b, double radius);

}  // namespace dipper::machine
