// A sieve curve, and size classes that represent it.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "coupler/case/case.hpp"

namespace dipper::cases {

/// Share of the rock's mass that passes a sieve, against the sieve's size; both rise.
class SieveCurve {
 public:
  struct Point {
    double size_m;
    double passing_percent;
    int line = 0;  ///< of its file
  };
  explicit SieveCurve(std::vector<Point> points) : points_(std::move(points)) {}

  double smallest_m() const { return points_.front().size_m; }
  double largest_m() const { return points_.back().size_m; }
  const std::vector<Point>& points() const { return points_; }
  /// Linear between points over the logarithm of the size; constant beyond its ends.
  double passing_percent(double size_m) const;
  /// The size within [low_m, high_m] that a share of the mass passes: the inverse of the above.
  double size_m(double passing_percent, double low_m, double high_m) const;

 private:
  std::vector<Point> points_;
};

/// Reads a CSV with the columns size_m, passing_percent (a header line, `#` comments, sizes rising
/// or falling). Throws InputError naming file and line: a field that is not a number, a size that
/// is not above zero or given twice, a share outside 0 ... 100 or one that falls while the size
/// rises, fewer than two points; sizes that go beyond 10 m, shares that go up to 1 only, or of 1
/// first and of 100 then.
SieveCurve read_sieve(const std::filesystem::path& file);

/// Shares up to 1 and then one at least a hundred times the last of them, as where shares of 1 are
/// followed by per cent.
struct ShareJump {
  SieveCurve::Point from, to;
  /// At least two shares up to 1, and the next is more than ten times what a straight line through
  /// the steepest of them leads to (log over log). Curves of rock are concave there: Rosin-Rammler,
  /// Gaudin-Schuhmann.
  bool certain;
};

/// The jump of points with rising sizes, if there is one.
std::optional<ShareJump> find_share_jump(const std::vector<SieveCurve::Point>& points);

/// Classes whose bounds are evenly spaced over log size between the truncation's ends (0: the
/// curve's). The mass of a class is that of the curve between its bounds; its size halves
/// that mass. Truncation keeps the mass: finer rock is counted in the smallest class, coarser rock
/// in the largest, so that the curve is unchanged at every bound. A class without
/// mass is left out. Names are sK_MM: the K-th, of MM mm. Throws std::invalid_argument: nothing
/// between the truncation's ends.
std::vector<SizeClass> size_classes(const SieveCurve& curve, const SieveCase& how);

}  // namespace dipper::cases
