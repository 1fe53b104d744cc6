#include "analysis/rock/surface_profile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "analysis/rock/median.hpp"

namespace dipper::analysis::rock {
namespace {

constexpr std::size_t kMostColumns = 4'000'000;  // 32 MB; beyond that, coarser cells are used

struct Extent {
  double x0 = std::numeric_limits<double>::infinity(), x1 = -x0;
  double y0 = x0, y1 = -x0;  // of the centres
  double smallest_m = x0;
};

Extent extent(const std::vector<Sphere>& balls) {
  Extent e;
  for (const Sphere& b : balls) {
    if (!b.centre_m.allFinite() || !(b.radius_m > 0) || !std::isfinite(b.radius_m))
      throw std::invalid_argument("a ball must have a finite centre and a radius > 0");
    e.x0 = std::min(e.x0, b.centre_m.x() - b.radius_m);
    e.x1 = std::max(e.x1, b.centre_m.x() + b.radius_m);
    e.y0 = std::min(e.y0, b.centre_m.y());
    e.y1 = std::max(e.y1, b.centre_m.y());
    e.smallest_m = std::min(e.smallest_m, b.radius_m);
  }
  return e;
}

}  // namespace

SurfaceProfile surface_profile(const std::vector<Sphere>& balls, const SurfaceOptions& options) {
  if (balls.empty()) throw std::invalid_argument("a surface needs at least one ball");
  const Extent e = extent(balls);
  double cell = options.cell_m > 0 ? options.cell_m : e.smallest_m / 4;
  const double area = (e.x1 - e.x0) * std::max(e.y1 - e.y0, cell);
  cell = std::max({cell, std::sqrt(area / static_cast<double>(kMostColumns)),
                   (e.x1 - e.x0) / static_cast<double>(kMostColumns)});
  const double step = std::max(cell, options.step_m > 0 ? options.step_m : e.smallest_m / 2);

  // Columns at the centres of cells; one row of them for a bed that is one ball wide.
  const auto nx = static_cast<std::size_t>(std::ceil((e.x1 - e.x0) / cell));
  const auto ny = std::max<std::size_t>(1, static_cast<std::size_t>((e.y1 - e.y0) / cell));
  const double y_first = (e.y0 + e.y1 - static_cast<double>(ny - 1) * cell) / 2;
  const auto x_of = [&](std::size_t i) { return e.x0 + (static_cast<double>(i) + 0.5) * cell; };
  const auto y_of = [&](std::size_t j) { return y_first + static_cast<double>(j) * cell; };
  std::vector<double> height(nx * ny, options.floor_m);
  for (const Sphere& b : balls) {
    const double r = b.radius_m;
    const auto from = [&](double first, double lowest) {
      return static_cast<std::size_t>(std::max(0.0, std::ceil((lowest - first) / cell)));
    };
    for (std::size_t i = from(x_of(0), b.centre_m.x() - r); i < nx; ++i) {
      const double dx = x_of(i) - b.centre_m.x();
      if (dx > r) break;
      const double chord = std::sqrt(std::max(0.0, r * r - dx * dx));
      for (std::size_t j = from(y_of(0), b.centre_m.y() - chord); j < ny; ++j) {
        const double dy = y_of(j) - b.centre_m.y();
        if (dy > chord) break;
        double& z = height[i * ny + j];
        z = std::max(z, b.centre_m.z() + std::sqrt(std::max(0.0, chord * chord - dy * dy)));
      }
    }
  }

  SurfaceProfile profile;
  profile.step_m = step;
  const auto bins = static_cast<std::size_t>(std::ceil((e.x1 - e.x0) / step - 1e-9));
  std::vector<double> in_bin;
  std::size_t i = 0;
  for (std::size_t k = 0; k < bins; ++k) {
    const double end = e.x0 + static_cast<double>(k + 1) * step;
    in_bin.clear();
    for (; i < nx && x_of(i) < end; ++i)
      for (std::size_t j = 0; j < ny; ++j) in_bin.push_back(height[i * ny + j]);
    if (in_bin.empty()) break;  // the last cell extends beyond the last bin
    profile.x_m.push_back(end - step / 2);
    profile.z_m.push_back(median(in_bin));
  }
  return profile;
}

}  // namespace dipper::analysis::rock
