#include "common/range.hpp"

#include <fmt/format.h>

namespace dipper {

bool Range::holds(double x) const {
  return (low_open ? x > low : x >= low) && (high_open ? x < high : x <= high);
}

std::string Range::text() const {
  const bool has_low = low > -1e300;
  const bool has_high = high < 1e300;
  if (low == high) return fmt::format("{:g}", low);
  if (has_low && has_high && !low_open && !high_open)
    return fmt::format("{:g} ... {:g}", low, high);
  const std::string above = fmt::format("{} {:g}", low_open ? ">" : ">=", low);
  const std::string below = fmt::format("{} {:g}", high_open ? "<" : "<=", high);
  if (has_low && has_high) return above + " and " + below;
  return has_low ? above : has_high ? below : "";
}

}  // namespace dipper
