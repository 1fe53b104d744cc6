#include "coupler/deck/domain_split.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "coupler/deck/pile_shape.hpp"

namespace dipper::deck {
namespace {

/// The bench's section in (x, z), from the toe to the rear wall.
class Bench {
 public:
  explicit Bench(const cases::Case& c) : c_(c), shape_(pile_shape(c)), outline_(bench_outline(c)) {}
  /// Height of the bench at x.
  double top(double x) const {
    return x > shape_.rear_x_m ? 0 : cases::outline_height(outline_, x);
  }
  /// Area of the section between two x and two z.
  double area(double x0, double x1, double z0, double z1) const {
    constexpr int kSlices = 200;
    const double from = std::max(x0, shape_.toe_x_m), to = std::min(x1, shape_.rear_x_m);
    if (to <= from) return 0;
    double sum = 0;
    for (int i = 0; i < kSlices; ++i) {
      const double x = from + (i + 0.5) * (to - from) / kSlices;
      sum += std::clamp(top(x), std::max(z0, 0.0), std::max(z1, 0.0)) - std::max(z0, 0.0);
    }
    return sum * (to - from) / kSlices;
  }
  /// Share of the width between two y.
  double width(double y0, double y1) const {
    const double half = c_.pile.width_m / 2;
    return std::max(0.0, std::min(y1, half) - std::max(y0, -half)) / (2 * half);
  }

 private:
  const cases::Case& c_;
  PileShape shape_;
  cases::BenchOutline outline_;
};

struct Grid {
  double largest_fraction = 0, cut_m2 = 0;
};

Grid measure(const cases::Case& c, const Bench& bench, const std::array<int, 3>& parts) {
  constexpr double kFar = 1e9;
  std::array<std::vector<double>, 3> cuts;
  for (int k = 0; k < 3; ++k) {
    const double lo = c.domain.min_m[k], hi = c.domain.max_m[k];
    for (int i = 0; i <= parts[k]; ++i) cuts[k].push_back(lo + (hi - lo) * i / parts[k]);
  }
  const auto& [x, y, z] = cuts;
  const double all = bench.area(-kFar, kFar, 0, kFar);
  Grid grid;
  double widest = 0, fullest = 0;
  for (std::size_t j = 0; j + 1 < y.size(); ++j)
    widest = std::max(widest, bench.width(y[j], y[j + 1]));
  for (std::size_t i = 0; i + 1 < x.size(); ++i)
    for (std::size_t k = 0; k + 1 < z.size(); ++k)
      fullest = std::max(fullest, bench.area(x[i], x[i + 1], z[k], z[k + 1]) / all);
  grid.largest_fraction = widest * fullest;
  for (std::size_t i = 1; i + 1 < x.size(); ++i) grid.cut_m2 += bench.top(x[i]) * c.pile.width_m;
  for (std::size_t j = 1; j + 1 < y.size(); ++j)
    if (std::abs(y[j]) < c.pile.width_m / 2) grid.cut_m2 += all;
  for (std::size_t k = 1; k + 1 < z.size(); ++k) {
    constexpr double kSlab = 1e-3;  // m: the section's length at z
    grid.cut_m2 += bench.area(-kFar, kFar, z[k], z[k] + kSlab) / kSlab * c.pile.width_m;
  }
  return grid;
}

}  // namespace

DomainSplit best_split(const cases::Case& c, int ranks) {
  const Bench bench(c);
  struct Choice {
    std::array<int, 3> parts;
    Grid grid;
  };
  std::vector<Choice> choices;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 1; i <= ranks; ++i) {
    if (ranks % i != 0) continue;
    for (int j = 1; j <= ranks / i; ++j) {
      if (ranks / i % j != 0) continue;
      const std::array<int, 3> parts{i, j, ranks / i / j};
      choices.push_back({parts, measure(c, bench, parts)});
      least = std::min(least, choices.back().grid.largest_fraction);
    }
  }
  const Choice* best = nullptr;
  for (const Choice& choice : choices) {
    if (choice.grid.largest_fraction > kSameShare * least) continue;
    if (best == nullptr || choice.grid.cut_m2 < best->grid.cut_m2) best = &choice;
  }
  return {best->parts, best->grid.largest_fraction};
}

}  // namespace dipper::deck
