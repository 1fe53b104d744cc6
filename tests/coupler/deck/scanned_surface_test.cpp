// A bench cut to a scanned surface that rises, is twisted and has an upright step: what is left is
// that surface, at every x and y, and no other.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include "analysis/io/dump_reader.hpp"
#include "coupler/case/bench_surface.hpp"
#include "coupler/deck/deck.hpp"
#include "coupler/result/achieved_profile.hpp"
#include "coupler/result/first_dump.hpp"
#include "tests/coupler/deck/height_field.hpp"
#include "tests/coupler/deck/quick_case.hpp"
#include "tests/coupler/deck/settled_bench.hpp"
#include "tests/places.hpp"

namespace dipper::deck {
namespace {

namespace fs = std::filesystem;

constexpr double kRock = 0.4, kToe = 13, kStep = 15, kRear = 17, kHalf = 2;

double wanted(double x, double y) {
  return 0.8 + (x - kToe) * (0.45 + 0.15 * y) + (x > kStep ? 0.6 : 0);
}

cases::Case scanned_case() {
  const double wide = kHalf + 0.5;  // a scan reaches beyond the bench
  const std::vector<double> y = {-wide, -1, 0, 0.7, wide};
  mesh::TriangleMesh mesh = height_field({kToe, 13.5, kStep}, y, wanted);
  add(mesh, height_field({kStep + 1e-9, 16, kRear}, y, wanted));
  cases::Case c = tiny_case();
  c.pile.width_m = 2 * kHalf;
  c.pile.profile = "scan.stl";
  c.pile.surface = std::make_shared<cases::BenchSurface>(mesh);
  c.pile.outline_m = c.pile.surface->section(kHalf, 1);
  c.rock.classes = {{"d200", kRock / c.rock.coarse_graining, 100, {"sphere"}}};
  return c;
}

using Rock = std::array<double, 4>;  // x, y, z, radius

/// The tops of the rocks that show, seen from above, over `surface`: the mean on each square of
/// `side`.
template <class Surface>
std::vector<double> over(const std::vector<Rock>& rocks, double side, const Surface& surface) {
  std::map<std::pair<int, int>, std::vector<double>> squares;
  for (const auto& [x, y, z, r] : rocks) {
    double top = 0;
    for (const auto& [ox, oy, oz, s] : rocks) {
      const double left = s * s - std::pow(x - ox, 2) - std::pow(y - oy, 2);
      if (left > 0) top = std::max(top, oz + std::sqrt(left));
    }
    if (top > z + r + 1e-9) continue;
    squares[{static_cast<int>((x - kToe) / side), static_cast<int>((y + kHalf) / side)}].push_back(
        z + r - surface(x, y));
  }
  std::vector<double> out;
  for (const auto& [square, d] : squares)
    out.push_back(std::accumulate(d.begin(), d.end(), 0.0) / static_cast<double>(d.size()));
  return out;
}

double largest(const std::vector<double>& v) {
  double most = 0;
  for (const double x : v) most = std::max(most, std::abs(x));
  return most;
}

TEST(ScannedSurface, IsReproducedAtTheCut) {
  const fs::path folder = fresh_folder("scanned");
  const cases::Case c = scanned_case();
  ASSERT_TRUE(c.pile.surface->faults(kHalf).empty());
  write_deck(c, test::source() / "meshes/rocks", folder / "deck");
  const fs::path dumps = settled_bench(folder, 0);
  std::vector<Rock> rocks;
  const analysis::io::DumpReader reader({result::first_dump(dumps)});
  analysis::io::DumpReader::read(reader.frames().front(), {"x", "y", "z", "radius"},
                                 [&](const analysis::io::ParticleChunk& chunk) {
                                   const auto& k = chunk.columns;
                                   for (std::size_t i = 0; i < chunk.rows; ++i)
                                     rocks.push_back({k[0][i], k[1][i], k[2][i], k[3][i]});
                                 });
  EXPECT_GT(rocks.size(), 400U);
  double highest = -1;  // of a centre over the surface
  for (const auto& [x, y, z, r] : rocks)
    highest = std::max(highest, z - c.pile.surface->height(x, y));
  const auto is = over(rocks, 2, wanted), finer = over(rocks, 1, wanted);
  const auto mirrored = over(rocks, 2, [](double x, double y) { return wanted(x, -y); });
  const auto level = over(rocks, 2, [](double x, double) { return wanted(x, 0); });
  const auto found = result::achieved_profile(c, dumps);
  ASSERT_TRUE(found);
  fmt::print(
      "{} rocks; off the surface by {:.2f} m at most on 2 m x 2 m, {:.2f} m on 1 m x 1 m; off the "
      "mirrored one by {:.2f} m, off its section by {:.2f} m; reported: {:.2f} m below\n",
      rocks.size(), largest(is), largest(finer), largest(mirrored), largest(level),
      found->below_mean_m);
  EXPECT_LT(highest, 0.01);  // it has moved a step since the cut
  EXPECT_LT(largest(is), kRock / 2);
  EXPECT_LT(largest(finer), kRock);
  EXPECT_GT(largest(mirrored), kRock);
  EXPECT_GT(largest(level), kRock);
  EXPECT_LT(std::abs(found->below_mean_m), kRock / 2);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace dipper::deck
