#include "coupler/deck/bench_cut.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <random>
#include <sstream>

#include "coupler/case/outline_file.hpp"
#include "tests/common/input_errors.hpp"

namespace dipper::deck {
namespace {

namespace fs = std::filesystem;

const cases::BenchOutline kBench = {{10, 0}, {14, 4}, {20, 4}};

double bench_height(double x_m, double) { return cases::outline_height(kBench, x_m); }

TEST(BenchCut, HeightOfTheOutline) {
  EXPECT_EQ(cases::outline_height(kBench, 9.9), 0);
  EXPECT_DOUBLE_EQ(cases::outline_height(kBench, 13), 3);
  EXPECT_DOUBLE_EQ(cases::outline_height(kBench, 16), 4);
  EXPECT_DOUBLE_EQ(cases::outline_height(kBench, 25), 4);
  const cases::BenchOutline upright = {{10, 0}, {10, 5}, {12, 6}};
  EXPECT_EQ(cases::outline_height(upright, 9.999), 0);
  EXPECT_DOUBLE_EQ(cases::outline_height(upright, 10), 5);
}

TEST(BenchCut, ARockGoesOrStaysAsAWholeByItsOwnCentre) {
  // Two rocks of a large and a small sphere; the volumes are 8 : 1.
  const std::vector<PileSphere> spheres = {
      {1, 7, {16, 0, 3.9}, 0.4},                                 // stays: centre at 3.97
      {2, 7, {16, 0, 4.5}, 0.2},   {3, 8, {17, 0, 4.1}, 0.4},    // goes: 4.04
      {4, 8, {17, 0, 3.6}, 0.2},   {5, -1, {18, 0, 3.99}, 0.3},  // a sphere by itself
      {6, -1, {18, 1, 4.01}, 0.3}, {7, -1, {9, 0, 0.1}, 0.1}};   // in front of the toe
  EXPECT_EQ(over_surface(spheres, bench_height), (std::vector<long>{3, 4, 6, 7}));
}

TEST(BenchCut, LargeAndSmallRocksStayInTheSameShare) {
  // Centres evenly in 0 < z < 8: half stay, of rocks of any size; 4 standard errors is 2.8 %.
  std::mt19937 random(1);
  std::uniform_real_distribution<double> z(0, 8);
  for (const double size : {0.1, 1.0}) {
    std::vector<PileSphere> spheres;
    for (long rock = 0; rock < 5000; ++rock) {
      const double at = z(random);
      spheres.push_back({2 * rock, rock, {16, 0, at + size / 2}, size / 2});
      spheres.push_back({2 * rock + 1, rock, {16, 0, at - size / 2}, size / 2});
    }
    const double gone = static_cast<double>(over_surface(spheres, bench_height).size()) / 10000;
    EXPECT_NEAR(gone, 0.5, 0.028) << size;
  }
}

TEST(BenchCut, CommandsFitLiggghtssLines) {
  EXPECT_EQ(waste_group({}), "group waste subtract all all\n");
  EXPECT_EQ(waste_group({4, 9}), "group waste subtract all all\ngroup waste id 4 9\n");
  std::vector<long> many;
  for (long k = 0; k < 250; ++k) many.push_back(100'000'000 + k);
  std::istringstream text(waste_group(many));
  int lines = 0;
  for (std::string line; std::getline(text, line); ++lines) EXPECT_LT(line.size(), 2048U);
  EXPECT_EQ(lines, 4);
}

class OutlineFile : public testing::Test {
 protected:
  ~OutlineFile() override { fs::remove(file_); }
  std::string read(const std::string& text) const {
    std::ofstream(file_) << text;
    std::string all;
    for (const std::string& fault : test::faults_of([&] { cases::read_outline(file_); }))
      all += fault.substr(file_.string().size()) + '\n';
    return all;
  }
  const fs::path file_ = fs::path(testing::TempDir()) / ("outline" + std::to_string(getpid()));
};

TEST_F(OutlineFile, ReadsWhatItWrites) {
  std::ofstream(file_) << cases::to_csv(kBench);
  EXPECT_EQ(cases::read_outline(file_), kBench);
}

TEST_F(OutlineFile, ReportsEveryMistakeByItsLine) {
  EXPECT_EQ(read("x,z\n"), ":1:1: header is \"x,z\"; it must be \"x_m,z_m\"\n");
  EXPECT_EQ(read("x_m,z_m\n0,0\n"), ": 1 points; an outline has at least two\n");
  EXPECT_EQ(read("# scan\nx_m,z_m\n0,0\n5,-1\n4,2\n6,three\n"),
            ":4: z_m is -1; the ground is at 0\n"
            ":5: x_m falls from 5 to 4; points run from the toe to the rear\n"
            ":6:3: z_m is \"three\"; it must be a finite number\n");
}

}  // namespace
}  // namespace dipper::deck
