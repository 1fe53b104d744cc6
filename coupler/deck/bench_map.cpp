#include "coupler/deck/bench_map.hpp"

#include <algorithm>
#include <cmath>

#include "coupler/case/bench_surface.hpp"
#include "coupler/case/outline_file.hpp"
#include "coupler/deck/pile_shape.hpp"

namespace dipper::deck {
namespace {

constexpr double kCell_m = 0.1;

int cells(double length_m) {
  return static_cast<int>(std::ceil(std::max(kCell_m, length_m) / kCell_m));
}

}  // namespace

HeightMap bench_map(const cases::Case& c) {
  const PileShape shape = pile_shape(c);
  HeightMap bench({shape.toe_x_m, -c.pile.width_m / 2, kCell_m,
                   cells(shape.rear_x_m - shape.toe_x_m), cells(c.pile.width_m)});
  const cases::BenchOutline outline = bench_outline(c);
  for (int i = 0; i < bench.grid().nx; ++i)
    for (int j = 0; j < bench.grid().ny; ++j)
      bench.at(i, j) = c.pile.surface ? c.pile.surface->height(bench.x_of(i), bench.y_of(j))
                                      : cases::outline_height(outline, bench.x_of(i));
  return bench;
}

}  // namespace dipper::deck
