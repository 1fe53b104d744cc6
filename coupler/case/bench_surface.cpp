#include "coupler/case/bench_surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace dipper::cases {
namespace {

using Eigen::Vector2d;

constexpr double kEdge_m = 1e-3;  // an edge is no sharper: the floats of an STL far from the origin
constexpr double kUpright_m = 1e-6;   // a facet narrower than this, seen from above
constexpr double kSame_m = 0.01;      // between heights of one surface
constexpr double kMostSteps = 2'000;  // along an axis: a mesh in millimetres must be reported, too

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Twice the facet's area, seen from above; negative when it is seen from below.
double doubled_area(const mesh::Triangle& t) {
  return cross((t[1] - t[0]).head<2>(), (t[2] - t[0]).head<2>());
}

bool is_upright(const mesh::Triangle& t) {
  double longest = 0;
  for (std::size_t k = 0; k < 3; ++k)
    longest = std::max(longest, (t[(k + 1) % 3] - t[k]).head<2>().norm());
  return std::abs(doubled_area(t)) <= kUpright_m * longest;
}

std::vector<double> places(double from, double to) {
  const auto n =
      static_cast<int>(std::clamp(std::ceil((to - from) / BenchSurface::kStep_m), 1.0, kMostSteps));
  std::vector<double> out;
  for (int i = 0; i <= n; ++i) out.push_back(from + (to - from) * i / n);
  return out;
}

}  // namespace

BenchSurface::BenchSurface(mesh::TriangleMesh mesh)
    : mesh_(std::move(mesh)),
      box_(mesh::bounding_box(mesh_)),
      cells_(static_cast<std::size_t>(
          std::clamp(std::sqrt(static_cast<double>(mesh_.triangles.size())), 1.0, 1e3))),
      facets_in_(cells_ * cells_) {
  for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
    const mesh::Triangle t = mesh_.corners(i);
    if (is_upright(t)) continue;
    Box b;
    for (const Eigen::Vector3d& p : t) b.add(p, kReach_m);
    const auto low = cell(b.min_m.x(), b.min_m.y()), high = cell(b.max_m.x(), b.max_m.y());
    for (std::size_t m = low[0]; m <= high[0]; ++m)
      for (std::size_t n = low[1]; n <= high[1]; ++n) facets_in_[m * cells_ + n].push_back(i);
  }
}

std::array<std::size_t, 2> BenchSurface::cell(double x_m, double y_m) const {
  const auto index = [&](double at, int axis) {
    const double share = (at - box_.min_m[axis]) / (box_.max_m[axis] - box_.min_m[axis]);
    const auto most = static_cast<double>(cells_ - 1);
    return static_cast<std::size_t>(share > 0 ? std::min(share * static_cast<double>(cells_), most)
                                              : 0);
  };
  return {index(x_m, 0), index(y_m, 1)};
}

std::vector<BenchSurface::Hit> BenchSurface::hits(double x_m, double y_m) const {
  const Vector2d p(x_m, y_m);
  const auto [m, n] = cell(x_m, y_m);
  std::vector<Hit> out;
  for (const std::size_t i : facets_in_[m * cells_ + n]) {
    const mesh::Triangle t = mesh_.corners(i);
    const double doubled = doubled_area(t);
    Hit hit{std::numeric_limits<double>::infinity(), 0};
    double weights = 0;
    for (std::size_t k = 0; k < 3; ++k) {  // by the edge opposite to corner k
      const Vector2d from = t[(k + 1) % 3].head<2>(), edge = t[(k + 2) % 3].head<2>() - from;
      const double weight = cross(edge, p - from) / doubled;
      hit.inside_m = std::min(hit.inside_m, weight * std::abs(doubled) / edge.norm());
      hit.z_m += std::max(0.0, weight) * t[k].z();
      weights += std::max(0.0, weight);
    }
    hit.z_m /= weights;
    if (hit.inside_m > -kReach_m) out.push_back(hit);
  }
  return out;
}

double BenchSurface::height(double x_m, double y_m) const {
  if (x_m < box_.min_m.x()) return 0;
  const auto all =
      hits(std::min(x_m, box_.max_m.x()), std::clamp(y_m, box_.min_m.y(), box_.max_m.y()));
  const auto best = std::max_element(
      all.begin(), all.end(), [](const Hit& a, const Hit& b) { return a.inside_m < b.inside_m; });
  return best == all.end() ? 0 : std::max(0.0, best->z_m);
}

BenchOutline BenchSurface::section(double half_width_m, double share) const {
  BenchOutline out;
  for (const double x : places(box_.min_m.x(), box_.max_m.x())) {
    std::vector<double> z;
    for (const double y : places(-half_width_m, half_width_m)) z.push_back(height(x, y));
    const auto at = z.begin() + std::lround(share * static_cast<double>(z.size() - 1));
    std::nth_element(z.begin(), at, z.end());
    out.emplace_back(x, *at);
  }
  return out;
}

std::vector<std::string> BenchSurface::faults(double half_width_m) const {
  std::vector<Vector2d> looked_at;
  for (const double x : places(box_.min_m.x(), box_.max_m.x()))
    for (const double y : places(-half_width_m, half_width_m)) looked_at.emplace_back(x, y);
  const auto grid = static_cast<double>(looked_at.size());
  for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
    const auto [a, b, c] = mesh_.corners(i);
    const Vector2d middle = (a + b + c).head<2>() / 3;
    if (std::abs(middle.y()) <= half_width_m) looked_at.push_back(middle);
  }
  struct Place {
    Vector2d at{0, 0};
    double low = 0, high = 0;
  } apart, deepest;
  std::vector<Vector2d> bare;
  for (const Vector2d& p : looked_at) {
    bool covered = false;
    std::optional<Place> strictly;  // upright steps have two heights at their edge
    for (const Hit& h : hits(p.x(), p.y())) {
      if (h.inside_m < -kEdge_m) continue;
      covered = true;
      if (h.z_m < deepest.low) deepest = {p, h.z_m, 0};
      if (h.inside_m < kEdge_m) continue;
      if (!strictly) strictly = Place{p, h.z_m, h.z_m};
      strictly->low = std::min(strictly->low, h.z_m);
      strictly->high = std::max(strictly->high, h.z_m);
    }
    if (!covered) bare.push_back(p);
    if (strictly && strictly->high - strictly->low > apart.high - apart.low) apart = *strictly;
  }
  const auto place = [](const Vector2d& p) {
    return fmt::format("x = {:.4g} m, y = {:.4g} m", p.x(), p.y());
  };
  std::vector<std::string> out;
  if (!bare.empty())
    out.push_back(fmt::format(
        "leaves {:.3g} % of the bench uncovered, {} for one; it lies at y = {:g} to {:g} m and "
        "must "
        "cover y = {:g} to {:g} m (pile.width_m) all the way from x = {:g} to {:g} m: crop it to a "
        "rectangle, or make the bench narrower",
        100 * static_cast<double>(bare.size()) / grid, place(bare.front()), box_.min_m.y(),
        box_.max_m.y(), -half_width_m, half_width_m, box_.min_m.x(), box_.max_m.x()));
  if (apart.high - apart.low > kSame_m)
    out.push_back(fmt::format(
        "overhangs: facets are at z = {:.4g} m and {:.4g} m at {}; from above a place has "
        "one height: keep the upper facets",
        apart.low, apart.high, place(apart.at)));
  if (deepest.low < -kFloor_m)
    out.push_back(fmt::format("is {:.3g} m under the ground at {}; the ground is at z = 0",
                              -deepest.low, place(deepest.at)));
  return out;
}

}  // namespace dipper::cases
