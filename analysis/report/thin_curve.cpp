#include "analysis/report/thin_curve.hpp"

#include <cmath>
#include <limits>

namespace dipper::analysis::report {
namespace {

/// Calls do(begin, end) for each bin.
template <class Do>
void each_bin(std::size_t rows, std::size_t bins, Do&& act) {
  for (std::size_t k = 0; k < bins; ++k) act(k * rows / bins, (k + 1) * rows / bins);
}

}  // namespace

std::vector<double> thin_times(const std::vector<double>& time_s, std::size_t bins) {
  if (time_s.size() <= 2 * bins) return time_s;
  std::vector<double> out;
  each_bin(time_s.size(), bins, [&](std::size_t begin, std::size_t end) {
    out.push_back(time_s[begin]);
    out.push_back(time_s[(begin + end) / 2]);
  });
  return out;
}

std::vector<double> thin_values(const std::vector<double>& values, std::size_t bins) {
  if (values.size() <= 2 * bins) return values;
  std::vector<double> out;
  each_bin(values.size(), bins, [&](std::size_t begin, std::size_t end) {
    std::size_t low = end, high = end;
    for (std::size_t i = begin; i < end; ++i) {
      if (!std::isfinite(values[i])) continue;
      if (low == end || values[i] < values[low]) low = i;
      if (high == end || values[i] > values[high]) high = i;
    }
    const double none = std::numeric_limits<double>::quiet_NaN();
    if (low == end) {
      out.insert(out.end(), {none, none});
    } else {
      out.push_back(values[std::min(low, high)]);
      out.push_back(values[std::max(low, high)]);
    }
  });
  return out;
}

}  // namespace dipper::analysis::report
