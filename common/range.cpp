#include "common/range.hpp"

#include <fmt/format.h>

#include <cmath>

namespace dipper {
namespace {

/// In the usual form: 2147483647, 1e12, 0.25.
std::string written(double x) {
  if (std::abs(x) < 1e10 && x == std::round(x)) return fmt::format("{:.0f}", x);
  std::string text = fmt::format("{:g}", x);
  if (const auto plus = text.find("e+"); plus != std::string::npos) text.erase(plus + 1, 1);
  return text;
}

}  // namespace

bool Range::holds(double x) const {
  return (low_open ? x > low : x >= low) && (high_open ? x < high : x <= high);
}

std::string Range::text() const {
  const bool has_low = low > -1e300;
  const bool has_high = high < 1e300;
  if (low == high) return written(low);
  if (has_low && has_high && !low_open && !high_open) return written(low) + " ... " + written(high);
  const std::string above = (low_open ? "> " : ">= ") + written(low);
  const std::string below = (high_open ? "< " : "<= ") + written(high);
  if (has_low && has_high) return above + " and " + below;
  return has_low ? above : has_high ? below : "";
}

}  // namespace dipper
