#include "common/record/columns.hpp"

#include <algorithm>
#include <cmath>

#include "common/input_error.hpp"
#include "common/record/record.hpp"

namespace dipper::record {
namespace {

constexpr double kLongest_s = 1e5;  // of end_s

}  // namespace

void Columns::read(const std::string& channel, std::size_t column) {
  std::vector<double> values = read_channel(record_, channel, column);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double v = values[i];
    const bool in_time =
        channel != "time_s" || (v >= 0 && v < 1.001 * kLongest_s && (i == 0 || v > values[i - 1]));
    if (std::isfinite(v) && in_time) continue;
    throw InputError({{record_, 0, channel,
                       "is damaged: row " + std::to_string(i) + " holds " + std::to_string(v)}});
  }
  rows_ = std::min(rows_, values.size());
  values_[{channel, column}] = std::move(values);
}

std::vector<double> Columns::get(const std::string& channel, std::size_t column) const {
  std::vector<double> values = values_.at({channel, column});
  values.resize(rows_);
  return values;
}

}  // namespace dipper::record
