// Curves with as many points as a screen can show, with every peak kept.
#pragma once

#include <cstddef>
#include <vector>

namespace dipper::analysis::report {

/// Which rows a page keeps: for each of `bins` equal numbers of rows the first and the middle one
/// give the times; all of them when there are no more rows than that.
std::vector<double> thin_times(const std::vector<double>& time_s, std::size_t bins);

/// For each bin its smallest and its largest value, in the order in which they came; as many
/// values as `thin_times` has times. Values that are not numbers are skipped.
std::vector<double> thin_values(const std::vector<double>& values, std::size_t bins);

}  // namespace dipper::analysis::report
