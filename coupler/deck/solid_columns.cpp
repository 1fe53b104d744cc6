#include "coupler/deck/solid_columns.hpp"

#include <algorithm>
#include <cmath>

namespace dipper::deck {
namespace {

using Eigen::Vector3d;

/// Twice the area of (a, b, p) in the plane, positive to the left of a -> b. The two facets of an
/// edge get values that are exactly opposite, and -0 and +0 where p is on the edge: no line passes
/// between them or counts both.
double side(const Vector3d& a, std::size_t ia, const Vector3d& b, std::size_t ib, double x,
            double y) {
  if (ia > ib) return -side(b, ib, a, ia, x, y);
  const double twice = (b.x() - a.x()) * (y - a.y()) - (b.y() - a.y()) * (x - a.x());
  return twice == 0 ? 0.0 : twice;  // never -0: the sign of zero is the edge's
}

struct Crossing {
  double z;
  int turn;  // +1 into the solid going up, -1 out of it
};

}  // namespace

void join(Spans& spans) {
  std::sort(spans.begin(), spans.end());
  std::size_t kept = 0;
  for (const auto& s : spans) {
    if (kept > 0 && s.first <= spans[kept - 1].second) {
      spans[kept - 1].second = std::max(spans[kept - 1].second, s.second);
    } else {
      spans[kept++] = s;
    }
  }
  spans.resize(kept);
}

double difference(const Spans& a, const Spans& b) {
  double both = 0, all = 0;
  for (const auto& s : a) all += s.second - s.first;
  for (const auto& s : b) all += s.second - s.first;
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    both += std::max(0.0, std::min(a[i].second, b[j].second) - std::max(a[i].first, b[j].first));
    a[i].second < b[j].second ? ++i : ++j;
  }
  return all - 2 * both;
}

SolidColumns::SolidColumns(const mesh::TriangleMesh& mesh, int cells, double margin) {
  Box box;
  for (const Vector3d& v : mesh.vertices) box.add(v, margin);
  const Vector3d sides = box.sides_m();
  corner_ = box.min_m;
  cell_ = sides.head<2>().maxCoeff() / cells;
  nx_ = static_cast<std::size_t>(std::ceil(sides.x() / cell_));
  ny_ = static_cast<std::size_t>(std::ceil(sides.y() / cell_));

  std::vector<std::vector<Crossing>> crossings(nx_ * ny_);
  const auto first = [&](double lo, double from) {
    return static_cast<std::size_t>(std::max(0.0, std::floor((lo - from) / cell_ - 0.5)));
  };
  for (const auto& t : mesh.triangles) {
    const Vector3d &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    const double x_max = std::max({a.x(), b.x(), c.x()}), y_max = std::max({a.y(), b.y(), c.y()});
    for (std::size_t i = first(std::min({a.x(), b.x(), c.x()}), corner_.x()); i < nx_; ++i) {
      const double px = corner_.x() + (static_cast<double>(i) + 0.5) * cell_;
      if (px > x_max) break;
      for (std::size_t j = first(std::min({a.y(), b.y(), c.y()}), corner_.y()); j < ny_; ++j) {
        const double py = corner_.y() + (static_cast<double>(j) + 0.5) * cell_;
        if (py > y_max) break;
        const double wa = side(b, t[1], c, t[2], px, py), wb = side(c, t[2], a, t[0], px, py),
                     wc = side(a, t[0], b, t[1], px, py);
        const bool left = !std::signbit(wa) && !std::signbit(wb) && !std::signbit(wc);
        const bool right = std::signbit(wa) && std::signbit(wb) && std::signbit(wc);
        if ((!left && !right) || wa + wb + wc == 0) continue;
        const double z = (wa * a.z() + wb * b.z() + wc * c.z()) / (wa + wb + wc);
        crossings[i * ny_ + j].push_back({z, left ? -1 : 1});  // a facet that faces up is an exit
      }
    }
  }
  spans_.resize(crossings.size());
  for (std::size_t k = 0; k < crossings.size(); ++k) {
    auto& line = crossings[k];
    std::sort(line.begin(), line.end(),
              [](const Crossing& p, const Crossing& q) { return p.z < q.z; });
    int winding = 0;
    for (const Crossing& p : line) {
      if (winding == 0 && p.turn > 0) spans_[k].emplace_back(p.z, p.z);
      winding += p.turn;
      if (winding == 0 && p.turn < 0 && !spans_[k].empty()) spans_[k].back().second = p.z;
    }
  }
}

std::pair<double, double> SolidColumns::index(std::size_t column) const {
  return {static_cast<double>(column / ny_), static_cast<double>(column % ny_)};
}

bool SolidColumns::inside(const Vector3d& p) const {
  const double i = std::floor((p.x() - corner_.x()) / cell_),
               j = std::floor((p.y() - corner_.y()) / cell_);
  if (i < 0 || j < 0 || i >= static_cast<double>(nx_) || j >= static_cast<double>(ny_))
    return false;
  for (const auto& s : spans_[static_cast<std::size_t>(i) * ny_ + static_cast<std::size_t>(j)])
    if (p.z() > s.first && p.z() < s.second) return true;
  return false;
}

double SolidColumns::volume_m3() const {
  double length = 0;
  for (const Spans& spans : spans_)
    for (const auto& s : spans) length += s.second - s.first;
  return length * cell_ * cell_;
}

}  // namespace dipper::deck
