// The allowed numbers of a key.
#pragma once

#include <string>

namespace dipper {

/// An interval, each end open or closed. By default every number.
struct Range {
  double low = -1e300;
  double high = 1e300;
  bool low_open = false;
  bool high_open = false;

  bool holds(double x) const;  ///< false for nan
  std::string text() const;    ///< "> 0", "0 ... 180", "" when everything is allowed
};

}  // namespace dipper
