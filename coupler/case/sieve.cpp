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

using Point = SieveCurve::Point;

constexpr double kLargestSize = 10;  // [m]; of rock.sieve.max_size_m, too
constexpr double kLeast_mm = 200;    // of a curve's largest size: a smaller one is no bench's in mm

/// A share up to this may be one of 1, with per cent a hundred times as large.
constexpr double kWholeShare = 1;
constexpr double kPercent = 100;
constexpr double kFarAbove = 10;  ///< so many times what the finer sieves lead to

bool rises_somewhere(const std::vector<Point>& points) {
  for (std::size_t i = 1; i < points.size(); ++i)
    if (points[i].passing_percent > points[i - 1].passing_percent) return true;
  return false;
}

/// A fault of a curve as a whole, with sizes that rise: another unit, shares of 1, shares retained.
/// Reported once, not for each row.
Finding fault_of_all(const fs::path& file, const std::vector<Point>& points) {
  if (points.size() < 2) return {};
  const Point &finest = points.front(), &coarsest = points.back();
  const auto [least, most] = std::minmax_element(
      points.begin(), points.end(),
      [](const Point& a, const Point& b) { return a.passing_percent < b.passing_percent; });
  if (coarsest.size_m > kLargestSize)
    return {file, 0, "",
            fmt::format("size_m goes from {:g} to {:g} m; up to {:g} m: in {}, perhaps? 1000 mm = "
                        "1 m",
                        finest.size_m, coarsest.size_m, kLargestSize,
                        coarsest.size_m < kLeast_mm ? "mm, cm or inches" : "mm")};
  if (most->passing_percent <= kWholeShare)
    return {file, 0, "",
            fmt::format("passing_percent goes from {:g} to {:g}; up to 100 %: shares of 1, "
                        "perhaps? 1 = 100 %",
                        least->passing_percent, most->passing_percent)};
  if (finest.passing_percent > coarsest.passing_percent && !rises_somewhere(points))
    return {file, 0, "",
            fmt::format("passing_percent falls from {:g} to {:g} as size_m rises from {:g} to {:g} "
                        "m; what passes a sieve passes every larger one: shares retained, perhaps? "
                        "passing is 100 less retained",
                        finest.passing_percent, coarsest.passing_percent, finest.size_m,
                        coarsest.size_m)};
  if (const auto jump = find_share_jump(points); jump && jump->certain)
    return {file, jump->to.line, "",
            fmt::format("passing_percent jumps from {:g} at {:g} m, line {}, to {:g} at {:g} m: "
                        "shares of 1 and per cent in one curve, perhaps? write all in per cent, "
                        "1 = 100 %; if all are per cent, leave out those up to 1 but one",
                        jump->from.passing_percent, jump->from.size_m, jump->from.line,
                        jump->to.passing_percent, jump->to.size_m)};
  return {};
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
  std::vector<Point> points;
  for (const CsvRow& row : read_csv(file, {"size_m", "passing_percent"}, faults)) {
    const double size = row.values[0], passing = row.values[1];
    if (size <= 0) {
      fault(row.line, fmt::format("size_m is {:g}; it must be above 0", size));
    } else if (passing < 0 || passing > 100) {
      fault(row.line, fmt::format("passing_percent is {:g}; it must be 0 ... 100", passing));
    } else {
      points.push_back({size, passing, row.line});
    }
  }
  std::stable_sort(points.begin(), points.end(),
                   [](const Point& a, const Point& b) { return a.size_m < b.size_m; });
  if (Finding wrong = fault_of_all(file, points); faults.empty() && !wrong.message.empty()) {
    faults.push_back(std::move(wrong));
    throw InputError(std::move(faults));
  }
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Point &a = points[i - 1], &b = points[i];
    if (a.size_m == b.size_m) {
      fault(b.line, fmt::format("size_m {:g} is in line {} already", b.size_m, a.line));
    } else if (b.passing_percent < a.passing_percent) {
      fault(b.line,
            fmt::format("passing_percent {:g} at {:g} m is below the {:g} at {:g} m of line {}; "
                        "what passes a sieve passes every larger one",
                        b.passing_percent, b.size_m, a.passing_percent, a.size_m, a.line));
    }
  }
  if (faults.empty() && points.size() < 2)
    fault(0, fmt::format("{} points; a curve has at least two", points.size()));
  if (faults.empty()) return SieveCurve(std::move(points));
  sort_by_line(faults);
  throw InputError(std::move(faults));
}

std::optional<ShareJump> find_share_jump(const std::vector<Point>& points) {
  const auto to = std::find_if(points.begin(), points.end(),
                               [](const Point& p) { return p.passing_percent > kWholeShare; });
  if (to == points.begin() || to == points.end()) return std::nullopt;
  const auto from = to - 1;
  if (from->passing_percent <= 0 || to->passing_percent < kPercent * from->passing_percent)
    return std::nullopt;
  int shares = 1;
  double steepest = 0;
  for (auto b = from; b != points.begin() && (b - 1)->passing_percent > 0; --b, ++shares)
    if (const auto a = b - 1; b->size_m > a->size_m)
      steepest = std::max(steepest, std::log(b->passing_percent / a->passing_percent) /
                                        std::log(b->size_m / a->size_m));
  const double led_to = from->passing_percent * std::pow(to->size_m / from->size_m, steepest);
  return ShareJump{*from, *to, shares > 1 && to->passing_percent > kFarAbove * led_to};
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
