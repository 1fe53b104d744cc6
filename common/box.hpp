#pragma once

#include <Eigen/Core>
#include <limits>

namespace dipper {

/// An axis-aligned box [m]; the user states the axes. Empty (min > max) until something is added.
struct Box {
  Eigen::Vector3d min_m = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d max_m = Eigen::Vector3d::Constant(-std::numeric_limits<double>::infinity());

  static constexpr int kCorners = 8;

  /// The corner at the upper face of each axis whose bit in `k` is set: bit 0 is x, bit 2 z.
  Eigen::Vector3d corner(int k) const {
    return {(k & 1 ? max_m : min_m).x(), (k & 2 ? max_m : min_m).y(), (k & 4 ? max_m : min_m).z()};
  }

  Eigen::Vector3d sides_m() const { return max_m - min_m; }
  bool is_empty() const { return (min_m.array() > max_m.array()).any(); }

  /// Points on its faces are inside.
  bool holds(const Eigen::Vector3d& p) const {
    return (p.array() >= min_m.array()).all() && (p.array() <= max_m.array()).all();
  }

  /// Between the nearest points of the two, m; 0 where they touch.
  double distance_m(const Box& other) const {
    return (min_m - other.max_m).cwiseMax(other.min_m - max_m).cwiseMax(0).norm();
  }

  /// Extended by `by_m` on every side.
  Box grown(double by_m) const { return {min_m.array() - by_m, max_m.array() + by_m}; }

  /// A cube of half side `margin_m` about `point`.
  void add(const Eigen::Vector3d& point, double margin_m = 0) {
    min_m = min_m.cwiseMin(point - Eigen::Vector3d::Constant(margin_m));
    max_m = max_m.cwiseMax(point + Eigen::Vector3d::Constant(margin_m));
  }
};

}  // namespace dipper
