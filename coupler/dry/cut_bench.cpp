#include "coupler/dry/cut_bench.hpp"

#include <algorithm>
#include <cmath>

#include "coupler/case/bench_surface.hpp"
#include "coupler/case/outline_file.hpp"
#include "coupler/deck/pile_shape.hpp"

namespace dipper::dry {
namespace {

std::size_t cells(double length_m) {
  return static_cast<std::size_t>(std::ceil(std::max(0.0, length_m) / CutBench::kCell_m));
}

int steps(double length_m) {
  return 1 + static_cast<int>(std::ceil(length_m / (0.5 * CutBench::kCell_m)));
}

}  // namespace

CutBench::CutBench(const cases::Case& c)
    : x0_(deck::pile_shape(c).toe_x_m),
      y0_(-c.pile.width_m / 2),
      nx_(cells(deck::pile_shape(c).rear_x_m - x0_)),
      ny_(cells(c.pile.width_m)) {
  const cases::BenchOutline outline = deck::bench_outline(c);
  for (std::size_t i = 0; i < nx_; ++i)
    for (std::size_t j = 0; j < ny_; ++j) {
      const double x = x0_ + (static_cast<double>(i) + 0.5) * kCell_m,
                   y = y0_ + (static_cast<double>(j) + 0.5) * kCell_m;
      z_.push_back(c.pile.surface ? c.pile.surface->height(x, y)
                                  : cases::outline_height(outline, x));
    }
}

std::optional<std::size_t> CutBench::cell(double x, double y) const {
  const double i = std::floor((x - x0_) / kCell_m), j = std::floor((y - y0_) / kCell_m);
  if (i < 0 || j < 0 || i >= static_cast<double>(nx_) || j >= static_cast<double>(ny_))
    return std::nullopt;
  return static_cast<std::size_t>(i) * ny_ + static_cast<std::size_t>(j);
}

double CutBench::height(double x, double y) const {
  const auto k = cell(x, y);
  return k ? z_[*k] : 0;
}

double CutBench::cut(const Vector3d& left_from, const Vector3d& right_from, const Vector3d& left_to,
                     const Vector3d& right_to) {
  const int across = steps((left_to - right_to).norm());
  const int along = steps(std::max((left_to - left_from).norm(), (right_to - right_from).norm()));
  double volume_m3 = 0;
  for (int k = 1; k <= along; ++k) {
    const double t = static_cast<double>(k) / along;
    const Vector3d left = left_from + t * (left_to - left_from),
                   right = right_from + t * (right_to - right_from);
    for (int j = 0; j <= across; ++j) {
      const Vector3d p = left + (right - left) * j / across;
      const auto here = cell(p.x(), p.y());
      const double left_over_m = std::max(p.z(), 0.0);
      if (!here || z_[*here] <= left_over_m) continue;
      volume_m3 += (z_[*here] - left_over_m) * kCell_m * kCell_m;
      z_[*here] = left_over_m;
    }
  }
  return volume_m3;
}

}  // namespace dipper::dry
