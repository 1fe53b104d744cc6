#include "coupler/case/sieve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/csv_table.hpp"
#include "common/input_error.hpp"

namespace dipper::cases {
namespace {

namespace fs = std::filesystem;

struct Row {
  SieveCurve::Point point;
  int line;
};

constexpr double kLargestSize = 10;  // [m]; of rock.sieve.max_size_m, too

/// Faults of a curve as a whole: another unit, shares of 1, shares retained. Reported once, not for
/// each row.
std::string fault_of_all(const std::vector<Row>& rows) {
  if (rows.size() < 2) return "";
  double smallest = rows[0].point.size_m, largest = 0, least = rows[0].point.passing_percent;
  double most = least;
  const Row *finest = &rows[0], *coarsest = &rows[0];
  for (const Row& row : rows) {
    if (row.point.size_m < finest->point.size_m) finest = &row;
    if (row.point.size_m > coarsest->point.size_m) coarsest = &row;
    smallest = std::min(smallest, row.point.size_m);
    largest = std::max(largest, row.point.size_m);
    least = std::min(least, row.point.passing_percent);
    most = std::max(most, row.point.passing_percent);
  }
  if (largest > kLargestSize)
    return fmt::format(
        "size_m goes from {:g} to {:g} m; up to {:g} m: in mm, perhaps? 1000 mm = 1 m", smallest,
        largest, kLargestSize);
  if (most <= 1)
    return fmt::format(
        "passing_percent goes from {:g} to {:g}; up to 100 %: shares of 1, perhaps? 1 = 100 %",
        least, most);
  if (finest->point.passing_percent > coarsest->point.passing_percent)
    return fmt::format(
        "passing_percent falls from {:g} to {:g} as size_m rises from {:g} to {:g} m; what passes "
        "a "
        "sieve passes every larger one: shares retained, perhaps? passing is 100 less retained",
        finest->point.passing_percent, coarsest->point.passing_percent, smallest, largest);
  return "";
}

}  // namespace

double SieveCurve::passing_percent(double size) const {
  if (size <= smallest_m()) return points_.front().passing_percent;
  if (size >= largest_m()) return points_.back().passing_percent;
  const auto above = std::find_if(points_.begin(), points_.end(),
                                  [&](const Point& p) { return p.size_m >= size; });
  const Point &b = *above, &a = *(above - 1);
  const double t = std::log(size / a.size_m) / std::log(b.size_m / a.size_m);
  return a.passing_percent + t * (b.passing_percent - a.passing_percent);
}

double SieveCurve::size_m(double passing, double low_m, double high_m) const {
  double lo = std::log(low_m), hi = std::log(high_m);
  for (int k = 0; k < 60; ++k) {
    const double mid = (lo + hi) / 2;
    (passing_percent(std::exp(mid)) < passing ? lo : hi) = mid;
  }
  return std::exp((lo + hi) / 2);
}

SieveCurve read_sieve(const fs::path& file) {
  std::vector<Finding> faults;
  const auto fault = [&](int line, const std::string& what) {
    faults.push_back({file, line, "", what});
  };
  std::vector<Row> rows;
  for (const CsvRow& row : read_csv(file, {"size_m", "passing_percent"}, faults)) {
    const double size = row.values[0], passing = row.values[1];
    if (size <= 0) {
      fault(row.line, fmt::format("size_m is {:g}; it must be above 0", size));
    } else if (passing < 0 || passing > 100) {
      fault(row.line, fmt::format("passing_percent is {:g}; it must be 0 ... 100", passing));
    } else {
      rows.push_back({{size, passing}, row.line});
    }
  }
  std::stable_sort(rows.begin(), rows.end(),
                   [](const Row& a, const Row& b) { return a.point.size_m < b.point.size_m; });
  if (const std::string wrong = fault_of_all(rows); faults.empty() && !wrong.empty()) {
    fault(0, wrong);
    throw InputError(std::move(faults));
  }
  std::vector<SieveCurve::Point> points;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    points.push_back(rows[i].point);
    if (i == 0) continue;
    const Row &a = rows[i - 1], &b = rows[i];
    if (a.point.size_m == b.point.size_m) {
      fault(b.line, fmt::format("size_m {:g} is in line {} already", b.point.size_m, a.line));
    } else if (b.point.passing_percent < a.point.passing_percent) {
      fault(
          b.line,
          fmt::format("passing_percent {:g} at {:g} m is below the {:g} at {:g} m of line {}; what "
                      "passes a sieve passes every larger one",
                      b.point.passing_percent, b.point.size_m, a.point.passing_percent,
                      a.point.size_m, a.line));
    }
  }
  if (faults.empty() && points.size() < 2)
    fault(0, fmt::format("{} points; a curve has at least two", points.size()));
  if (faults.empty()) return SieveCurve(std::move(points));
  sort_by_line(faults);
  throw InputError(std::move(faults));
}

std::vector<SizeClass> size_classes(const SieveCurve& curve, const SieveCase& how) {
  const double low = how.min_size_m > 0 ? how.min_size_m : curve.smallest_m(),
               high = how.max_size_m > 0 ? how.max_size_m : curve.largest_m();
  if (low >= high)
    throw std::invalid_argument(fmt::format(
        "nothing between the smallest size, {:g} m, and the largest, {:g} m", low, high));
  const auto bound = [&](int k) { return low * std::pow(high / low, double(k) / how.classes); };
  std::vector<SizeClass> out;
  for (int k = 0; k < how.classes; ++k) {
    const double a = bound(k), b = k + 1 == how.classes ? high : bound(k + 1);
    const double from = curve.passing_percent(a), to = curve.passing_percent(b);
    const double mass = (k + 1 == how.classes ? 100 : to) - (k == 0 ? 0 : from);
    if (mass <= 0) continue;
    SizeClass c;
    c.size_m = to > from ? curve.size_m((from + to) / 2, a, b) : std::sqrt(a * b);
    c.name = fmt::format("s{}_{:.0f}", k + 1, 1000 * c.size_m);
    c.mass_percent = mass;
    c.shapes = c.size_m < how.spheres_below_m || how.shapes.empty()
                   ? std::vector<std::string>{"sphere"}
                   : how.shapes;
    out.push_back(c);
  }
  return out;
}

}  // namespace dipper::cases
