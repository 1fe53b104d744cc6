// The slope of a curve through points that does not overshoot them.
#pragma once

#include <algorithm>
#include <cmath>

namespace dipper::machine {

/// At a point between two others: that of the parabola through the three, limited to keep the cubic
/// of either side monotone (Hyman 1983, SIAM J. Sci. Stat. Comput. 4:645); 0 where the values turn.
/// `h` is the distance of the points, `d` the slope of the line from one to the next; before,
/// after.
inline double monotone_slope(double h0, double d0, double h1, double d1) {
  if (d0 * d1 <= 0) return 0;
  const double parabola = (h1 * d0 + h0 * d1) / (h0 + h1);
  const double most = 3 * std::min(std::abs(d0), std::abs(d1));
  return std::clamp(parabola, -most, most);
}

}  // namespace dipper::machine
