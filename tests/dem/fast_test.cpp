// The fast time loop, lists and contact forces do what LIGGGHTS's do.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "common/frames.hpp"
#include "tests/common/mesh/shapes.hpp"
#include "tests/places.hpp"

namespace dipper::dem {
namespace {

namespace fs = std::filesystem;

constexpr int kColumns = 13;  // id, x, v, omega, f
constexpr int kAll = 2500;    // steps: much of the rock lies on other rock
constexpr int kFirst = 1500;  // the first rocks touch, none so many that the order of a sum matters

/// Falls into a bin; LIGGGHTS's dump after so many steps, a row a sphere.
std::vector<std::vector<double>> end_of(const std::string& program, int ranks,
                                        const std::string& rock, int steps) {
  const fs::path out = fs::temp_directory_path() / fmt::format("dipper_fast_{}", getpid());
  fs::remove_all(out);
  fs::create_directories(out);
  std::ofstream(out / "floor.stl")
      << test::ascii_stl(test::box(Vector3d(-1.5, -1.5, -0.3), Vector3d(1.5, 1.5, 0)));
  std::ofstream(out / "paddle.stl")
      << test::ascii_stl(test::box(Vector3d(-0.3, -0.3, 4), Vector3d(0.3, 0.3, 4.3)));
  const std::string mpi =
      ranks == 1 ? "" : fmt::format("mpirun --allow-run-as-root --oversubscribe -np {}", ranks);
  const std::string command = fmt::format(
      "cd '{0}' && {1} {2} -in '{3}/fast.in' -var folder '{3}' -var rock {4} -var out . -var "
      "run_steps 0 -var near 1.02 -var steps {5} -log log.txt > screen.txt 2>&1",
      out.string(), mpi, program, test::dem_tests().string(), rock, steps);
  EXPECT_EQ(std::system(command.c_str()), 0) << command;
  std::ifstream in(out / fmt::format("rock_{}.dump", steps));
  std::string line;
  while (std::getline(in, line) && line.rfind("ITEM: ATOMS", 0) != 0) continue;
  std::vector<std::vector<double>> rows;
  for (std::vector<double> row(kColumns); in;) {
    for (double& x : row) in >> x;
    if (in) rows.push_back(row);
  }
  fs::remove_all(out);
  return rows;
}

const std::string kPlain = "'" + test::liggghts().string() + "'",
                  kFast = "'" + test::dipper_liggghts().string() + "'";

class Fast : public testing::TestWithParam<std::tuple<const char*, int>> {};

TEST_P(Fast, MovesRockAsLiggghts) {
  const auto [rock, ranks] = GetParam();
  const auto plain = end_of(kPlain, ranks, rock, kAll), ours = end_of(kFast, ranks, rock, kAll);
  ASSERT_GT(plain.size(), 100U);
  ASSERT_EQ(ours.size(), plain.size());
  double off_m = 0, off_m_s = 0, most_m_s = 0;
  std::size_t touched = 0;
  for (std::size_t n = 0; n < plain.size(); ++n) {
    ASSERT_EQ(ours[n][0], plain[n][0]);
    for (int k = 1; k < 4; ++k) off_m = std::max(off_m, std::abs(ours[n][k] - plain[n][k]));
    for (int k = 4; k < 7; ++k) {
      off_m_s = std::max(off_m_s, std::abs(ours[n][k] - plain[n][k]));
      most_m_s = std::max(most_m_s, std::abs(plain[n][k]));
    }
    touched += std::abs(plain[n][10]) > 1e-9 ? 1 : 0;
  }
  fmt::print("{}, {} ranks: {} spheres, {} touched: off by {:.1e} m, {:.1e} of {:.2f} m/s\n", rock,
             ranks, plain.size(), touched, off_m, off_m_s, most_m_s);
  EXPECT_GT(touched, plain.size() / 4);
  EXPECT_LT(off_m, 1e-9);
  EXPECT_LT(off_m_s, 1e-7);
}

TEST_P(Fast, HasLiggghtssBitsWhileNoSumHasAnotherOrder) {
  const auto [rock, ranks] = GetParam();
  const auto plain = end_of(kPlain, ranks, rock, kFirst);
  ASSERT_GT(plain.size(), 100U);
  EXPECT_GT(std::count_if(plain.begin(), plain.end(), [](const auto& row) { return row[10] != 0; }),
            5);
  EXPECT_EQ(end_of(kFast, ranks, rock, kFirst), plain);
}

TEST_P(Fast, LeavesAllToLiggghtsWhenAsked) {
  const auto [rock, ranks] = GetParam();
  const auto plain = end_of(kPlain, ranks, rock, kAll);
  ASSERT_GT(plain.size(), 100U);
  EXPECT_EQ(end_of(kFast + " --loop liggghts", ranks, rock, kAll), plain);
}

INSTANTIATE_TEST_SUITE_P(Rock, Fast,
                         testing::Combine(testing::Values("spheres", "multispheres"),
                                          testing::Values(1, 2)));

}  // namespace
}  // namespace dipper::dem
