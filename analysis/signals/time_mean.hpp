// The rows in a time interval, and the mean of a signal over it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

namespace dipper::analysis::signals {

/// Rows of an interval, for the trapezoidal rule, up to and including row `last`.
struct RowSpan {
  std::size_t first = 0, last = 0;
  double share = 1;  ///< the interval's part of the time between these rows
};

/// The rows from the first at t_start_s or later to the first at t_end_s or later. If these are the
/// same row, as for a phase that begins between the last two rows of a run: the two rows around the
/// interval, with its part of the time between them. None without two rows.
inline std::optional<RowSpan> rows_within(const std::vector<double>& time_s, double t_start_s,
                                          double t_end_s) {
  constexpr double kRoundOff_s = 1e-9;
  if (time_s.size() < 2) return std::nullopt;
  const auto row = [&](double at_s) {
    const auto at = std::lower_bound(time_s.begin(), time_s.end(), at_s - kRoundOff_s);
    return std::min(static_cast<std::size_t>(at - time_s.begin()), time_s.size() - 1);
  };
  RowSpan rows{row(t_start_s), row(t_end_s), 1};
  if (rows.first < rows.last) return rows;
  rows.last = std::max<std::size_t>(rows.first, 1);
  rows.first = rows.last - 1;
  rows.share = (t_end_s - t_start_s) / (time_s[rows.last] - time_s[rows.first]);
  return rows;
}

/// Time-weighted mean of value(i), i an entry of time_s; an entry holds until the next, and counts
/// with the part of its time inside the interval. None without an entry.
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
