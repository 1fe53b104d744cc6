// A closed mesh as columns along z: quick and exact in z, for volumes and inside tests of a fit.
#pragma once

#include <utility>
#include <vector>

#include "common/mesh/triangle_mesh.hpp"

namespace dipper::deck {

/// The parts of a line inside a solid: disjoint intervals [m], in order.
using Spans = std::vector<std::pair<double, double>>;

/// Sorts intervals and joins those that overlap.
void join(Spans& spans);

/// Length [m] covered by exactly one of two joined sets of intervals.
double difference(const Spans& a, const Spans& b);

/// Lines along z on a square grid in (x, y). On each, the solid is a set of intervals whose ends
/// are exact; the relative error of a volume is that of the grid, about 1/cells^2.
class SolidColumns {
 public:
  /// `cells` lines across the longest side of the mesh's box, which is `margin` [m] wider all round
  /// than the mesh. A point is inside where the winding number is positive, so shells may overlap.
  SolidColumns(const mesh::TriangleMesh& mesh, int cells, double margin);

  double cell_m() const { return cell_; }
  std::size_t size() const { return spans_.size(); }
  double x(std::size_t column) const { return corner_.x() + (index(column).first + 0.5) * cell_; }
  double y(std::size_t column) const { return corner_.y() + (index(column).second + 0.5) * cell_; }
  const Spans& spans(std::size_t column) const { return spans_[column]; }

  /// Of the nearest column, exact in z.
  bool inside(const Eigen::Vector3d& p) const;
  double volume_m3() const;

 private:
  std::pair<double, double> index(std::size_t column) const;

  Eigen::Vector3d corner_;
  double cell_ = 0;
  std::size_t nx_ = 0, ny_ = 0;
  std::vector<Spans> spans_;  // x by x, y running fastest
};

}  // namespace dipper::deck
