#include "machine/truck_figure.hpp"

#include "common/mesh/solids.hpp"

namespace dipper::machine {

using mesh::append;
using mesh::block;
using mesh::both_sides;
using mesh::TriangleMesh;
using mesh::turned;

std::vector<FigurePart> truck_figure(const Box& box) {
  // The 793's overall length is 1.8 times its bed's, its tyres are 0.55 of the loading height.
  const double front = box.max_m.x(), l = box.sides_m().x(), w = box.sides_m().y() / 2,
               h = box.max_m.z(), r = 0.275 * h, wide = 0.16 * w;
  const auto tyre = [&](double x, double y) {
    return turned({{0.5 * r, y - wide},
                   {0.92 * r, y - wide},
                   {r, y - 0.6 * wide},
                   {r, y + 0.6 * wide},
                   {0.92 * r, y + wide},
                   {0.5 * r, y + wide}},
                  {x, 0, r}, 24);
  };
  const auto hub = [&](double x, double y) {
    return turned({{0.05 * r, y - 0.8 * wide},
                   {0.5 * r, y - 0.8 * wide},
                   {0.5 * r, y + 0.8 * wide},
                   {0.05 * r, y + 0.8 * wide}},
                  {x, 0, r}, 12);
  };
  const double rear = box.min_m.x() + 0.22 * l, steer = rear + 0.8 * l;
  TriangleMesh tyres, hubs;
  for (const auto& [x, y] : {std::pair{rear, 0.54 * w}, {rear, 0.9 * w}, {steer, 0.86 * w}}) {
    append(tyres, tyre(x, y));
    append(hubs, hub(x, y));
  }
  TriangleMesh axles = mesh::rod({{rear, -0.9 * w, r}, {rear, 0.9 * w, r}}, 0.3 * r, 12);
  append(axles, mesh::rod({{steer, -0.86 * w, r}, {steer, 0.86 * w, r}}, 0.22 * r, 12));
  const double nose = front + 0.42 * l, step = 0.6 * h;
  TriangleMesh frame = both_sides(
      block({box.min_m.x() + 0.1 * l, 0.2 * w, 0.3 * h}, {nose - 0.05 * l, 0.32 * w, 0.42 * h}));
  append(frame, block({front + 0.05 * l, -0.95 * w, step}, {nose, 0.95 * w, step + 0.03 * h}));
  append(frame, block({nose - 0.05 * l, -0.9 * w, 0.2 * h}, {nose + 0.01 * l, 0.9 * w, 0.28 * h}));
  return {{"tyres", both_sides(tyres)},
          {"hubs", both_sides(hubs)},
          {"axles", axles},
          {"truck frame", frame},
          {"truck engine", block({front + 0.1 * l, -0.42 * w, 0.28 * h}, {nose, 0.42 * w, step})},
          {"truck cab", block({front + 0.16 * l, 0.25 * w, step + 0.03 * h},
                              {nose - 0.05 * l, 0.85 * w, 0.94 * h})},
          {"window",
           block({front + 0.22 * l, 0.24 * w, 0.72 * h}, {nose - 0.045 * l, 0.86 * w, 0.88 * h})},
          {"truck canopy", mesh::plate({{front - 0.01 * l, 0.985 * h},
                                        {nose - 0.02 * l, 1.05 * h},
                                        {nose - 0.02 * l, 1.075 * h},
                                        {front - 0.01 * l, 1.015 * h}},
                                       -w, w)}};
}

}  // namespace dipper::machine
