// The cohesion model `moist` inside LIGGGHTS, against closed forms: two spheres led apart, and a
// cantilever of bonded spheres.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <vector>

#include "dem/moist/moist_law.hpp"
#include "tests/places.hpp"

namespace dipper::dem {
namespace {

namespace fs = std::filesystem;

/// Runs dipper-liggghts on a deck; returns the rows of the table it wrote.
std::vector<std::vector<double>> run(const std::string& deck, const std::string& table,
                                     std::size_t columns, const std::string& arguments) {
  const fs::path out = fs::temp_directory_path() / "dipper_moist";
  fs::remove_all(out);
  fs::create_directories(out);
  const std::string command = fmt::format(
      "'{}' -in '{}' -var out '{}' -log '{}' {} > '{}' 2>&1", test::dipper_liggghts().string(),
      (test::dem_tests() / deck).string(), out.string(), (out / "log.txt").string(), arguments,
      (out / "screen.txt").string());
  EXPECT_EQ(std::system(command.c_str()), 0) << command;
  std::ifstream in(out / table);
  std::string title;
  std::getline(in, title);
  std::vector<std::vector<double>> rows;
  for (std::vector<double> row(columns); in;) {
    for (double& x : row) in >> x;
    if (in) rows.push_back(row);
  }
  EXPECT_GT(rows.size(), 100U);
  return rows;
}

struct Led {
  double x, gap, fx, fz;  ///< of the led sphere; forces on it
};

std::vector<Led> lead(const std::string& arguments) {
  std::vector<Led> out;
  for (const auto& r : run("moist_pair.in", "pair.txt", 4, arguments)) {
    out.push_back({r[0], r[1], r[2], r[3]});
  }
  return out;
}

const Led& lowest_fz(std::vector<Led>::const_iterator begin, std::vector<Led>::const_iterator end) {
  return *std::min_element(begin, end, [](const Led& a, const Led& b) { return a.fz < b.fz; });
}

TEST(Moist, MoistRocksPartAtTheirPullOffForce) {
  for (const double r2 : {0.1, 0.25}) {
    const auto rows =
        lead(fmt::format("-var r2 {} -var pull_off 1.0e4 -var vz 5.0e-2 -var steps 12000", r2));
    const double d = moist::pair_diameter(0.1, r2), F = 1e4 * d * d, reach = 0.02 * (0.1 + r2);
    EXPECT_NEAR(-lowest_fz(rows.begin(), rows.end()).fz, F, 1e-2 * F) << r2;
    for (const Led& row : rows) {
      if (row.gap <= 0) continue;
      ASSERT_NEAR(-row.fz, F * std::max(0.0, 1 - row.gap / reach), 1e-6 * F) << row.gap;
    }
  }
}

TEST(Moist, ABondBreaksAtItsTensileStrengthForGood) {
  const auto rows = lead("-var tension 1.0e5 -var shear 1.0e9 -var vz 1.0e-3 -var back 20000");
  const double F = 1e5 * M_PI * 0.01;
  const auto& pull = lowest_fz(rows.begin(), rows.begin() + 20000);
  EXPECT_NEAR(-pull.fz, F, 2e-3 * F);
  EXPECT_NEAR(pull.gap, F / 1e7, 2e-3 * F / 1e7);
  // Led back into contact and away again: nothing holds it.
  EXPECT_LT(rows[40000].gap, 0);
  EXPECT_GT(lowest_fz(rows.begin() + 40001, rows.end()).fz, -1e-3 * F);
}

TEST(Moist, ABondBreaksAtItsShearStrength) {
  const auto rows = lead("-var tension 1.0e9 -var shear 1.0e5 -var vx 1.0e-3 -var steps 80000");
  double largest = 0, after = 0;
  for (const Led& row : rows) largest = std::max(largest, -row.fx);
  const double F = 1e5 * M_PI * 0.01;
  EXPECT_NEAR(largest, F, 5e-3 * F);
  for (const Led& row : rows) {
    if (row.x > 1.01 * F / 2.7e6) after = std::max(after, std::abs(row.fx));
  }
  EXPECT_LT(after, 1e-2 * F);
}

TEST(Moist, ACantileverBreaksAtItsRoot) {
  // Four discs, 0.7, 0.5, 0.3, 0.1 m from the load P. The root has the largest stress,
  // P L R/I = 4 P L/(pi R^3). The tip goes down by sum(P l^2)/k_b + 4 P/k_t, k_b = kn R^2/4.
  const auto rows = run("moist_beam.in", "beam.txt", 2, "");
  const double P = 1e6 * M_PI * 1e-3 / (4 * 0.7);
  const double compliance = (0.49 + 0.25 + 0.09 + 0.01) / (1e7 * 0.01 / 4) + 4 / 2.7e6;
  const auto broken = std::find_if(rows.begin(), rows.end(), [&](const auto& row) {
    return row[1] > 1.2 * row[0] * compliance && row[0] > 100;
  });
  ASSERT_NE(broken, rows.end());
  EXPECT_NEAR((*broken)[0], P, 0.03 * P);
  const auto half =
      std::find_if(rows.begin(), rows.end(), [&](const auto& row) { return row[0] > P / 2; });
  EXPECT_NEAR((*half)[1], P / 2 * compliance, 0.05 * P / 2 * compliance);
}

}  // namespace
}  // namespace dipper::dem
