#include "analysis/rock/solid_mass.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace dipper::analysis::rock {

double mass_inside(const std::vector<Sphere>& balls, const std::vector<double>& density_kg_m3,
                   const Box& box, double cell_m) {
  if (balls.size() != density_kg_m3.size())
    throw std::invalid_argument("balls and densities differ in number");
  if ((box.sides_m().array() <= 0).any()) throw std::invalid_argument("the box is empty");
  if (!(cell_m > 0)) throw std::invalid_argument("a cell's side must be > 0");
  // Whole cells along each side, so that their centres are evenly inside.
  std::array<std::size_t, 3> n{};
  Eigen::Vector3d cell;
  for (int a = 0; a < 3; ++a) {
    n[static_cast<std::size_t>(a)] =
        static_cast<std::size_t>(std::max(1.0, std::round(box.sides_m()[a] / cell_m)));
    cell[a] = box.sides_m()[a] / static_cast<double>(n[static_cast<std::size_t>(a)]);
  }
  std::vector<float> density(n[0] * n[1] * n[2], 0.0F);
  for (std::size_t b = 0; b < balls.size(); ++b) {
    const Eigen::Vector3d centre = balls[b].centre_m - box.min_m;
    const double r = balls[b].radius_m;
    std::array<std::size_t, 3> from{}, to{};  // cells whose centre may be inside
    bool outside = false;
    for (int a = 0; a < 3; ++a) {
      const auto s = static_cast<std::size_t>(a);
      const double lo = std::ceil((centre[a] - r) / cell[a] - 0.5);
      const double hi = std::floor((centre[a] + r) / cell[a] - 0.5) + 1;
      if (hi <= 0 || lo >= static_cast<double>(n[s])) outside = true;
      from[s] = static_cast<std::size_t>(std::max(0.0, lo));
      to[s] = static_cast<std::size_t>(std::clamp(hi, 0.0, static_cast<double>(n[s])));
    }
    if (outside) continue;
    const auto off = [&](int a, std::size_t i) {
      return (static_cast<double>(i) + 0.5) * cell[a] - centre[a];
    };
    for (std::size_t i = from[0]; i < to[0]; ++i)
      for (std::size_t j = from[1]; j < to[1]; ++j) {
        const double rest = r * r - off(0, i) * off(0, i) - off(1, j) * off(1, j);
        if (rest < 0) continue;
        for (std::size_t k = from[2]; k < to[2]; ++k)
          if (off(2, k) * off(2, k) <= rest)
            density[(i * n[1] + j) * n[2] + k] = static_cast<float>(density_kg_m3[b]);
      }
  }
  double sum = 0;
  for (const float d : density) sum += static_cast<double>(d);
  return sum * cell.prod();
}

}  // namespace dipper::analysis::rock
