// The bench as a surface that is dug away, without any rock in it.
#pragma once

#include <optional>
#include <vector>

#include "common/frames.hpp"
#include "coupler/case/case.hpp"

namespace dipper::dry {

/// Heights over the ground on a grid in W. What lies above a cut is gone: nothing comes down.
class CutBench {
 public:
  /// The case's bench, with z = 0 around it.
  explicit CutBench(const cases::Case& c);

  /// m; 0 beyond the grid.
  double height(double x, double y) const;

  /// Takes out what lies above the quadrangle that an edge sweeps as it goes from one place to
  /// another: volume, m^3.
  double cut(const Vector3d& left_from, const Vector3d& right_from, const Vector3d& left_to,
             const Vector3d& right_to);

  static constexpr double kCell_m = 0.1;

 private:
  std::optional<std::size_t> cell(double x, double y) const;

  double x0_, y0_;
  std::size_t nx_, ny_;
  std::vector<double> z_;
};

}  // namespace dipper::dry
