// A quadratic response surface over a few parameters: fitted to few, noisy runs.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace dipper::calibrate {

/// A point of the search: each parameter's range is scaled to -1 ... 1.
using Point = Eigen::VectorXd;

/// The design for k parameters: three levels of one; a face-centred central composite of two or
/// three (Box & Wilson 1951): corners, face centres, centre. 3, 9, 15 points. Throws
/// std::invalid_argument for other k.
std::vector<Point> composite_design(int k);

struct Prediction {
  double value = 0;
  double sigma = 0;  ///< standard error of the surface at the point
};

/// y = c0 + sum ci xi + sum cij xi xj (i <= j), by least squares.
class ResponseSurface {
 public:
  /// Needs more samples than terms, at points that determine the terms; throws
  /// std::invalid_argument otherwise.
  ResponseSurface(const std::vector<Point>& x, const std::vector<double>& y);

  Prediction at(const Point& x) const;
  Point gradient(const Point& x) const;

  const Eigen::VectorXd& coefficients() const { return coefficients_; }
  double residual_sigma() const { return residual_sigma_; }  ///< of one run about the surface
  int degrees_of_freedom() const { return degrees_of_freedom_; }

 private:
  Eigen::VectorXd coefficients_;
  Eigen::MatrixXd covariance_;
  double residual_sigma_ = 0;
  int degrees_of_freedom_ = 0;
};

/// Standard deviation of runs that differ only in the seed, pooled over the points with several
/// runs; none if there are no such points.
std::optional<double> seed_sigma(const std::vector<Point>& x, const std::vector<double>& y);

/// The point where the surface has the value `target`, reached from `start` by the shortest steps
/// (Newton along the gradient, inside -1 ... 1). None if the surface does not reach the value
/// there.
std::optional<Point> nearest_with(const ResponseSurface& s, double target, const Point& start);

/// Unit directions, perpendicular to the gradient at x and to each other, along which the surface
/// does not change: k - 1 of them. Empty for one parameter or no gradient.
std::vector<Point> neutral_directions(const ResponseSurface& s, const Point& x);

/// Follows the contour from x along `direction` until it leaves -1 ... 1 or turns back: the last
/// point inside.
Point follow(const ResponseSurface& s, const Point& x, const Point& direction);

}  // namespace dipper::calibrate
