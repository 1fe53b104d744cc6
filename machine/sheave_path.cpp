#include "machine/sheave_path.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace dipper::machine {
namespace {

/// The straight part at one end. side: +1 when the tangent point lies anticlockwise of the end.
struct Tangent {
  double length;    // end to tangent point
  double angle;     // of the tangent point about the centre
  Vector2d toward;  // unit, end to tangent point
};

Tangent tangent(const Vector2d& end, double radius, double side) {
  const double distance = end.norm();
  if (!(distance > radius)) {
    throw std::domain_error(fmt::format(
        "the rope's end is {:.3f} m from the sheave's axis, inside its radius of {:.3f} m",
        distance, radius));
  }
  const double angle = std::atan2(end.y(), end.x()) + side * std::acos(radius / distance);
  const double length = std::sqrt(distance * distance - radius * radius);
  const Vector2d point = radius * Vector2d(std::cos(angle), std::sin(angle));
  return {length, angle, (point - end) / length};
}

}  // namespace

SheavePath sheave_path(const Vector2d& a, const Vector2d& b, double radius) {
  constexpr double two_pi = 6.283185307179586;
  const Tangent at_a = tangent(a, radius, -1);
  const Tangent at_b = tangent(b, radius, +1);
  double wrap = std::fmod(at_a.angle - at_b.angle, two_pi);
  if (wrap < 0) wrap += two_pi;
  return {at_a.length + radius * wrap + at_b.length, at_b.length, wrap, at_a.toward, at_b.toward};
}

}  // namespace dipper::machine
