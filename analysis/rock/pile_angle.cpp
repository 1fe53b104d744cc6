#include "analysis/rock/pile_angle.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <stdexcept>

#include "analysis/rock/median.hpp"
#include "common/angles.hpp"

namespace dipper::analysis::rock {
namespace {

constexpr std::size_t kFewestBins = 5;
constexpr int kResamples = 200;

/// Running median over `width` bins, over fewer at the ends.
std::vector<double> smoothed(const std::vector<double>& z, std::size_t width) {
  const std::size_t half = width / 2;
  std::vector<double> out;
  for (std::size_t i = 0; i < z.size(); ++i) {
    const std::size_t reach = std::min({half, i, z.size() - 1 - i});
    const auto first = z.begin() + static_cast<std::ptrdiff_t>(i - reach);
    out.push_back(median({first, first + static_cast<std::ptrdiff_t>(2 * reach + 1)}));
  }
  return out;
}

/// Bins of a flank, in order of x.
struct Flank {
  std::size_t first = 0, count = 0;
};

/// Down from the crest on one side (step +1 or -1): from the first bin below the upper height to
/// the first below the lower. Empty when there is none.
Flank flank(const std::vector<double>& z, std::size_t crest, int step, double lower, double upper) {
  const auto n = static_cast<std::ptrdiff_t>(z.size());
  auto i = static_cast<std::ptrdiff_t>(crest);
  const auto at = [&](std::ptrdiff_t k) { return z[static_cast<std::size_t>(k)]; };
  while (i >= 0 && i < n && at(i) > upper) i += step;
  const std::ptrdiff_t top = i;
  while (i >= 0 && i < n && at(i) >= lower) i += step;
  if (i < 0 || i >= n || i == top) return {};
  const std::ptrdiff_t last = i - step;
  return {static_cast<std::size_t>(std::min(top, last)),
          static_cast<std::size_t>(std::abs(top - last) + 1)};
}

double theil_sen(const std::vector<double>& x, const std::vector<double>& z) {
  std::vector<double> slopes;
  slopes.reserve(x.size() * (x.size() - 1) / 2);
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t j = i + 1; j < x.size(); ++j) slopes.push_back((z[j] - z[i]) / (x[j] - x[i]));
  return median(std::move(slopes));
}

double angle_deg(double slope) { return degrees(std::atan(std::abs(slope))); }

/// Standard deviation of the angle over bootstrap samples of blocks of the residuals.
double bootstrap_sigma_deg(const std::vector<double>& x, const std::vector<double>& residual,
                           double slope, std::size_t block) {
  std::mt19937 draw(5489);  // fixed, so that a profile always gives the same value
  const std::size_t n = x.size();
  double sum = 0, sum_of_squares = 0;
  std::vector<double> z(n);
  for (int k = 0; k < kResamples; ++k) {
    for (std::size_t i = 0; i < n;) {
      const std::size_t from = draw() % n;
      for (std::size_t j = 0; j < block && i < n; ++j, ++i)
        z[i] = slope * x[i] + residual[(from + j) % n];
    }
    const double a = angle_deg(theil_sen(x, z));
    sum += a;
    sum_of_squares += a * a;
  }
  const double mean = sum / kResamples;
  // The fitted line takes two of the blocks' degrees of freedom.
  const double blocks = static_cast<double>(n) / static_cast<double>(block);
  const double lost = blocks > 3 ? blocks / (blocks - 2) : 3;
  return std::sqrt(lost * std::max(0.0, sum_of_squares / kResamples - mean * mean));
}

}  // namespace

PileAngle pile_angle(const SurfaceProfile& profile, double grain_m,
                     const PileAngleOptions& options) {
  std::vector<double> x, z;
  for (std::size_t i = 0; i < profile.x_m.size(); ++i) {
    if (profile.x_m[i] < options.x_min_m || profile.x_m[i] > options.x_max_m) continue;
    x.push_back(profile.x_m[i]);
    z.push_back(profile.z_m[i]);
  }
  const auto too_short = [] {
    return std::invalid_argument(
        "no flank: the surface must fall from the crest to the ground over at least 5 bins");
  };
  if (x.size() < kFewestBins) throw too_short();

  const auto block = static_cast<std::size_t>(std::max(1.0, std::round(grain_m / profile.step_m)));
  const std::vector<double> smooth = smoothed(z, block);
  const auto crest = static_cast<std::size_t>(
      std::distance(smooth.begin(), std::max_element(smooth.begin(), smooth.end())));
  PileAngle out;
  out.height_m = smooth[crest] - options.floor_m;
  const double lower = options.floor_m + options.lower_fraction * out.height_m;
  const double upper = options.floor_m + options.upper_fraction * out.height_m;
  const Flank left = flank(smooth, crest, -1, lower, upper);
  const Flank right = flank(smooth, crest, +1, lower, upper);
  const Flank f = left.count >= right.count ? left : right;
  if (f.count < kFewestBins) throw too_short();
  const auto cut = [&](std::vector<double>& v) {
    const auto first = v.begin() + static_cast<std::ptrdiff_t>(f.first);
    v = std::vector<double>(first, first + static_cast<std::ptrdiff_t>(f.count));
  };
  cut(x);
  cut(z);

  out.x_from_m = x.front();
  out.x_to_m = x.back();
  out.x0_m = (x.front() + x.back()) / 2;
  out.slope = theil_sen(x, z);
  out.angle_deg = angle_deg(out.slope);
  std::vector<double> residual;
  for (std::size_t i = 0; i < x.size(); ++i)
    residual.push_back(z[i] - out.slope * (x[i] - out.x0_m));
  out.z0_m = median(residual);
  for (double& r : residual) r -= out.z0_m;
  out.sigma_deg = bootstrap_sigma_deg(x, residual, out.slope, std::min(block, x.size()));
  return out;
}

PileAngle pile_angle(const std::vector<Sphere>& balls, const PileAngleOptions& options) {
  double largest = 0;
  for (const Sphere& b : balls) largest = std::max(largest, b.radius_m);
  SurfaceOptions surface;
  surface.floor_m = options.floor_m;
  return pile_angle(surface_profile(balls, surface), 2 * largest, options);
}

}  // namespace dipper::analysis::rock
