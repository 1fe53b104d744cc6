// The median.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace dipper::analysis::rock {

/// Of one value or more; the mean of the two in the middle of an even number.
inline double median(std::vector<double> v) {
  const auto middle = v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2);
  std::nth_element(v.begin(), middle, v.end());
  if (v.size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(v.begin(), middle)) / 2;
}

}  // namespace dipper::analysis::rock
