#include "coupler/calibrate/response_surface.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <stdexcept>

namespace dipper::calibrate {
namespace {

/// 1, x_i, x_i x_j (i <= j).
Eigen::VectorXd terms(const Point& x) {
  const Eigen::Index k = x.size();
  Eigen::VectorXd t(1 + k + k * (k + 1) / 2);
  Eigen::Index n = 0;
  t[n++] = 1;
  for (Eigen::Index i = 0; i < k; ++i) t[n++] = x[i];
  for (Eigen::Index i = 0; i < k; ++i)
    for (Eigen::Index j = i; j < k; ++j) t[n++] = x[i] * x[j];
  return t;
}

bool inside(const Point& x) { return x.cwiseAbs().maxCoeff() <= 1 + 1e-9; }

}  // namespace

std::vector<Point> composite_design(int k) {
  if (k < 1 || k > 3) throw std::invalid_argument("one to three parameters can be searched");
  std::vector<Point> out;
  int combinations = 1;
  for (int i = 0; i < k; ++i) combinations *= 3;
  for (int n = 0; n < combinations; ++n) {
    Point p(k);
    int rest = n, zeros = 0;
    for (int i = 0; i < k; ++i, rest /= 3) {
      p[i] = rest % 3 - 1;
      if (rest % 3 == 1) ++zeros;
    }
    // Corners have no zero coordinate, face centres all but one, the centre all.
    if (zeros == 0 || zeros >= k - 1) out.push_back(p);
  }
  return out;
}

ResponseSurface::ResponseSurface(const std::vector<Point>& x, const std::vector<double>& y) {
  if (x.empty() || x.size() != y.size())
    throw std::invalid_argument("points and values differ in number");
  const Eigen::Index n = static_cast<Eigen::Index>(x.size()), m = terms(x[0]).size();
  if (n <= m) throw std::invalid_argument("a surface needs more samples than terms");
  Eigen::MatrixXd A(n, m);
  for (Eigen::Index i = 0; i < n; ++i) A.row(i) = terms(x[static_cast<std::size_t>(i)]);
  const Eigen::Map<const Eigen::VectorXd> b(y.data(), n);
  // Normal equations: coordinates are within -1 and 1, so their condition is good. (QR takes thrice
  // as long to compile.)
  const Eigen::LDLT<Eigen::MatrixXd> normal(A.transpose() * A);
  if (normal.vectorD().minCoeff() < 1e-12 * normal.vectorD().maxCoeff())
    throw std::invalid_argument("the samples do not determine the terms");
  coefficients_ = normal.solve(A.transpose() * b);
  degrees_of_freedom_ = static_cast<int>(n - m);
  residual_sigma_ = (A * coefficients_ - b).norm() / std::sqrt(static_cast<double>(n - m));
  covariance_ = residual_sigma_ * residual_sigma_ * normal.solve(Eigen::MatrixXd::Identity(m, m));
}

Prediction ResponseSurface::at(const Point& x) const {
  const Eigen::VectorXd t = terms(x);
  return {coefficients_.dot(t), std::sqrt(std::max(0.0, t.dot(covariance_ * t)))};
}

Point ResponseSurface::gradient(const Point& x) const {
  const Eigen::Index k = x.size();
  Point g = coefficients_.segment(1, k);
  Eigen::Index n = 1 + k;
  for (Eigen::Index i = 0; i < k; ++i)
    for (Eigen::Index j = i; j < k; ++j, ++n) {
      g[i] += coefficients_[n] * x[j];
      g[j] += coefficients_[n] * x[i];
    }
  return g;
}

std::optional<double> seed_sigma(const std::vector<Point>& x, const std::vector<double>& y) {
  double squares = 0;
  int freedom = 0;
  std::vector<bool> seen(x.size(), false);
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (seen[i]) continue;
    std::vector<double> group;
    for (std::size_t j = i; j < x.size(); ++j) {
      if (seen[j] || (x[i] - x[j]).norm() > 1e-9) continue;
      seen[j] = true;
      group.push_back(y[j]);
    }
    const Eigen::Map<const Eigen::VectorXd> v(group.data(),
                                              static_cast<Eigen::Index>(group.size()));
    squares += (v.array() - v.mean()).square().sum();
    freedom += static_cast<int>(group.size()) - 1;
  }
  if (freedom == 0) return std::nullopt;
  return std::sqrt(squares / freedom);
}

std::optional<Point> nearest_with(const ResponseSurface& s, double target, const Point& start) {
  constexpr int kSteps = 200;
  constexpr double kNear = 1e-6;
  Point x = start.cwiseMax(-1).cwiseMin(1);
  for (int i = 0; i < kSteps; ++i) {
    const double off = target - s.at(x).value;
    if (std::abs(off) < kNear) return x;
    Point g = s.gradient(x);
    // A parameter at an end of its range that would have to go beyond it stays there.
    for (Eigen::Index j = 0; j < g.size(); ++j)
      if (std::abs(x[j]) > 1 - 1e-12 && g[j] * off * x[j] > 0) g[j] = 0;
    if (g.squaredNorm() < 1e-12) return std::nullopt;
    const Point step = g * (off / g.squaredNorm());
    x = (x + step * std::min(1.0, 0.5 / step.norm())).cwiseMax(-1).cwiseMin(1);
  }
  return std::nullopt;
}

std::vector<Point> neutral_directions(const ResponseSurface& s, const Point& x) {
  const Point g = s.gradient(x);
  if (g.norm() < 1e-9) return {};
  // The mirror image (Householder) that lays g along the first axis lays the others across g.
  Point v = g;
  v[0] += std::copysign(g.norm(), g[0]);
  std::vector<Point> out;
  for (Eigen::Index i = 1; i < g.size(); ++i) {
    Point across = v * (-2 * v[i] / v.squaredNorm());
    across[i] += 1;
    out.push_back(across);
  }
  return out;
}

Point follow(const ResponseSurface& s, const Point& x, const Point& direction) {
  constexpr double kStep = 0.01;
  const double value = s.at(x).value;
  Point at = x, ahead = direction.normalized();
  for (int i = 0; i < 1000; ++i) {
    Point g = s.gradient(at);
    if (g.norm() < 1e-9) return at;
    const Point along = ahead - g * (g.dot(ahead) / g.squaredNorm());
    if (along.norm() < 1e-3) return at;
    ahead = along.normalized();
    Point next = at + kStep * ahead;
    g = s.gradient(next);
    if (g.norm() < 1e-9) return at;
    next += g * ((value - s.at(next).value) / g.squaredNorm());  // back onto the contour
    if (!inside(next)) return at;
    at = next;
  }
  return at;
}

}  // namespace dipper::calibrate
