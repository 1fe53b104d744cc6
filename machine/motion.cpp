#include "machine/motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "common/angles.hpp"
#include "common/csv_table.hpp"
#include "common/input_error.hpp"
#include "common/seconds.hpp"
#include "machine/monotone_slope.hpp"

namespace dipper::machine {
namespace {

const std::vector<std::string> kColumns = {"time_s", "hoist_m", "crowd_m", "swing_deg", "door_deg"};
constexpr double kLongest_s = 1e4;  // a motion in ms of 10 s or more is longer
constexpr double kUsualRow_s = 60;  // rows further apart, as a rule: a motion in ms

double median_interval_s(const std::vector<std::int64_t>& t_ns) {
  std::vector<std::int64_t> steps;
  for (std::size_t i = 1; i < t_ns.size(); ++i) steps.push_back(t_ns[i] - t_ns[i - 1]);
  const auto middle = steps.begin() + static_cast<long>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return seconds(*middle);
}

Drives drives(const std::array<double, 4>& v) { return {v[0], v[1], v[2], v[3]}; }

}  // namespace

Motion Motion::load(const std::filesystem::path& file) {
  std::vector<Finding> faults;
  const std::vector<CsvRow> rows = read_csv(file, kColumns, faults);
  return Motion(rows, file, std::move(faults));
}

Motion Motion::parse(std::string_view text, const std::string& name) {
  std::vector<Finding> faults;
  const std::vector<CsvRow> rows = parse_csv(text, name, kColumns, faults);
  return Motion(rows, name, std::move(faults));
}

Motion::Motion(const std::vector<CsvRow>& rows, const std::filesystem::path& file,
               std::vector<Finding> faults) {
  const auto fault = [&](int line, const std::string& message) {
    faults.push_back({file, line, "", message, 1});
  };
  std::size_t not_later = 0, first_not_later = 0;  // a clock that was set back counts as one fault
  bool too_late = false;                           // so do all rows beyond the longest time
  for (const CsvRow& row : rows) {
    const auto& v = row.values;
    if (std::abs(v[0]) > kLongest_s) {
      if (!std::exchange(too_late, true))
        fault(row.line, fmt::format("time_s is {}; it must be within {:g} s: in ms, perhaps?", v[0],
                                    kLongest_s));
      continue;
    }
    const std::int64_t t_ns = std::llround(v[0] * 1e9);
    if (!t_ns_.empty() && t_ns <= t_ns_.back()) {
      if (++not_later == 1) {
        first_not_later = faults.size();
        fault(row.line, fmt::format("time_s is {}, not after the previous row ({} s)", v[0],
                                    seconds(t_ns_.back())));
      }
      continue;
    }
    t_ns_.push_back(t_ns);
    position_.push_back({v[1], v[2], radians(v[3]), radians(v[4])});
  }
  if (not_later > 1)
    faults[first_not_later].message +=
        fmt::format(", and the same in {} more rows; dipper import sorts a log", not_later - 1);
  if (faults.empty() && t_ns_.size() < 2)
    faults.push_back(
        {file, 0, "", fmt::format("{} row(s); a motion needs at least 2", t_ns_.size())});
  if (faults.empty())
    if (const double row_s = median_interval_s(t_ns_); row_s > kUsualRow_s)
      fault(rows[1].line,
            fmt::format("time_s has a row every {:g} s; up to {:g} s: in ms, perhaps?", row_s,
                        kUsualRow_s));
  if (!faults.empty()) {
    sort_by_line(faults);
    throw InputError(std::move(faults));
  }
  set_slopes();
}

Motion Motion::standing() const {
  constexpr std::int64_t kStand_ns = 10'000'000;
  Motion still;
  still.t_ns_ = {start_ns(), start_ns() + kStand_ns};
  still.position_ = {position_.front(), position_.front()};
  still.set_slopes();
  return still;
}

void Motion::extend(const Motion& more) {
  if (more.start_ns() <= end_ns())
    throw std::invalid_argument(
        fmt::format("a motion that ends at {} s cannot go on with a row at {} s", seconds(end_ns()),
                    seconds(more.start_ns())));
  t_ns_.insert(t_ns_.end(), more.t_ns_.begin(), more.t_ns_.end());
  position_.insert(position_.end(), more.position_.begin(), more.position_.end());
  set_slopes();
}

void Motion::set_slopes() {
  const std::size_t n = t_ns_.size();
  slope_.assign(n, {});
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double h0 = seconds(t_ns_[i] - t_ns_[i - 1]);
    const double h1 = seconds(t_ns_[i + 1] - t_ns_[i]);
    for (std::size_t j = 0; j < 4; ++j) {
      const double d0 = (position_[i][j] - position_[i - 1][j]) / h0;
      const double d1 = (position_[i + 1][j] - position_[i][j]) / h1;
      slope_[i][j] = monotone_slope(h0, d0, h1, d1);
    }
  }
}

DriveState Motion::at(double t_s) const {
  const double first = seconds(t_ns_.front());
  const double last = seconds(t_ns_.back());
  if (!(t_s >= first)) return {drives(position_.front()), {}, {}};
  if (t_s >= last) return {drives(position_.back()), {}, {}};
  const auto after = std::upper_bound(t_ns_.begin() + 1, t_ns_.end() - 1, t_s,
                                      [](double t, std::int64_t row) { return t < seconds(row); });
  const auto i = static_cast<std::size_t>(after - t_ns_.begin()) - 1;

  const double h = seconds(t_ns_[i + 1] - t_ns_[i]);
  const double s = (t_s - seconds(t_ns_[i])) / h;
  std::array<double, 4> x{}, v{}, a{};
  for (std::size_t j = 0; j < 4; ++j) {
    const double d = position_[i + 1][j] - position_[i][j];
    const double m0 = h * slope_[i][j];
    const double m1 = h * slope_[i + 1][j];
    // x = x0 + m0 s + c2 s^2 + c3 s^3
    const double c2 = 3 * d - 2 * m0 - m1;
    const double c3 = m0 + m1 - 2 * d;
    x[j] = position_[i][j] + s * (m0 + s * (c2 + s * c3));
    v[j] = (m0 + s * (2 * c2 + s * 3 * c3)) / h;
    a[j] = (2 * c2 + 6 * c3 * s) / (h * h);
  }
  return {drives(x), drives(v), drives(a)};
}

std::int64_t Motion::next_row_ns(std::int64_t t_ns) const {
  const auto row = std::upper_bound(t_ns_.begin(), t_ns_.end(), t_ns);
  return row == t_ns_.end() ? std::numeric_limits<std::int64_t>::max() : *row;
}

Drives Motion::value(std::int64_t t_ns) const { return at(seconds(t_ns)).position; }
Drives Motion::rate(std::int64_t t_ns) const { return at(seconds(t_ns)).rate; }
Drives Motion::acceleration(std::int64_t t_ns) const { return at(seconds(t_ns)).acceleration; }

}  // namespace dipper::machine
