#include "coupler/result/achieved_profile.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "analysis/rock/pile_angle.hpp"
#include "coupler/case/bench_surface.hpp"
#include "coupler/deck/contact_table.hpp"
#include "coupler/deck/pile_shape.hpp"
#include "coupler/result/first_dump.hpp"

namespace dipper::result {

std::optional<AchievedProfile> achieved_profile(const cases::Case& c,
                                                const std::filesystem::path& dumps) {
  const std::filesystem::path file = first_dump(dumps);
  if (file.empty()) return std::nullopt;
  std::vector<Sphere> balls;
  const analysis::io::DumpReader reader({file});
  analysis::io::DumpReader::read(reader.frames().front(), {"x", "y", "z", "radius"},
                                 [&](const analysis::io::ParticleChunk& chunk) {
                                   const auto& k = chunk.columns;
                                   for (std::size_t i = 0; i < chunk.rows; ++i)
                                     balls.push_back({{k[0][i], k[1][i], k[2][i]}, k[3][i]});
                                 });
  if (balls.empty()) return std::nullopt;

  double grain = 0;
  for (const deck::RockClass& k : deck::rock_classes(c)) grain = std::max(grain, 2 * k.radius_m);
  const analysis::rock::SurfaceProfile surface = analysis::rock::surface_profile(balls);
  const cases::BenchOutline outline =
      c.pile.surface ? c.pile.surface->section(c.pile.width_m / 2, 0.5) : deck::bench_outline(c);
  AchievedProfile out;
  try {
    out.face_deg = analysis::rock::pile_angle(surface, grain).angle_deg;
  } catch (const std::invalid_argument&) {
    // too low a bench to have a flank
  }
  // Bins beyond the ends of the profile have nothing to compare with.
  std::vector<double> x, below;
  for (std::size_t i = 0; i < surface.x_m.size(); ++i) {
    if (surface.x_m[i] < outline.front().x() || surface.x_m[i] > outline.back().x()) continue;
    x.push_back(surface.x_m[i]);
    below.push_back(cases::outline_height(outline, x.back()) - surface.z_m[i]);
    out.below_mean_m += below.back();
  }
  if (x.empty()) return out;
  out.below_mean_m /= static_cast<double>(x.size());
  const auto width = std::min(
      x.size(), static_cast<std::size_t>(std::max(1L, std::lround(grain / surface.step_m))));
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sum += below[i] - (i >= width ? below[i - width] : 0);
    const double mean = sum / static_cast<double>(width);
    if (i + 1 < width || (i + 1 > width && mean <= out.below_most_m)) continue;
    out.below_most_m = mean;
    out.below_most_x_m = (x[i] + x[i + 1 - width]) / 2;
  }
  return out;
}

}  // namespace dipper::result
