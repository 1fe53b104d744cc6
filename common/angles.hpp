// Degrees, for people, and radians, for computing.
#pragma once

namespace dipper {

constexpr double kRadPerDeg = 0.017453292519943295;  ///< pi / 180

constexpr double radians(double deg) { return deg * kRadPerDeg; }
constexpr double degrees(double rad) { return rad * 180 / 3.141592653589793; }

}  // namespace dipper
