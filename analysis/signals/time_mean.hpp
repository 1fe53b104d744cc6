// The mean of a signal over a part of its time.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

namespace dipper::analysis::signals {

/// Time-weighted mean of value(i), i an entry of time_s; an entry holds until the next, and counts
/// with the part of that which is within the time. None: no entry is.
template <class Value>
std::optional<double> time_mean(const std::vector<double>& time_s, double t_start_s, double t_end_s,
                                Value value) {
  double sum = 0, of_s = 0;
  for (std::size_t i = 0; i + 1 < time_s.size(); ++i) {
    const double from = std::max(time_s[i], t_start_s), to = std::min(time_s[i + 1], t_end_s);
    if (to <= from) continue;
    sum += value(i) * (to - from);
    of_s += to - from;
  }
  if (of_s <= 0) return std::nullopt;
  return sum / of_s;
}

}  // namespace dipper::analysis::signals
