#include "coupler/case/sieve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "tests/common/input_errors.hpp"
#include "tests/coupler/deck/liggghts_run.hpp"

namespace dipper::cases {
namespace {

namespace fs = std::filesystem;

fs::path curve_file(const std::string& rows) {
  const fs::path file = deck::fresh_folder("sieve") / "sieve.csv";
  std::ofstream(file) << "# of the bench\nsize_m, passing_percent\n" << rows;
  return file;
}

std::string errors_of(const std::string& rows) {
  return test::message_of([&] { read_sieve(curve_file(rows)); });
}

double total(const std::vector<SizeClass>& classes) {
  return std::accumulate(classes.begin(), classes.end(), 0.0,
                         [](double sum, const SizeClass& c) { return sum + c.mass_percent; });
}

TEST(Sieve, IsStraightOverTheLogarithm) {
  const SieveCurve curve = read_sieve(curve_file("1.6, 100\n0.1, 0\n0.4, 30\n"));
  EXPECT_NEAR(curve.passing_percent(0.2), 15, 1e-12);
  EXPECT_NEAR(curve.passing_percent(0.8), 65, 1e-12);
  EXPECT_EQ(curve.passing_percent(0.05), 0);
  EXPECT_EQ(curve.passing_percent(3), 100);
  EXPECT_NEAR(curve.size_m(65, 0.1, 1.6), 0.8, 1e-9);
}

TEST(Sieve, ClassesAddUpAndMeetTheCurveAtTheirBounds) {
  // passing = 25 log2(size/0.1): four classes of an octave each.
  const SieveCurve curve = read_sieve(curve_file("0.1,0\n1.6,100\n"));
  SieveCase how;
  how.classes = 4;
  how.spheres_below_m = 0.25;
  how.shapes = {"block"};
  const std::vector<SizeClass> classes = size_classes(curve, how);
  ASSERT_EQ(classes.size(), 4U);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(classes[k].mass_percent, 25, 1e-9);
    EXPECT_NEAR(classes[k].size_m, 0.1 * std::pow(2, double(k) + 0.5), 1e-9);
    EXPECT_EQ(classes[k].shapes[0], k == 0 ? "sphere" : k == 1 ? "block" : "block");
  }
  EXPECT_EQ(classes[0].name, "s1_141");
}

TEST(Sieve, WhatIsCutIsCountedInTheClassNextToIt) {
  const SieveCurve curve = read_sieve(curve_file("0.1,0\n1.6,100\n"));
  SieveCase how;
  how.classes = 2;
  how.min_size_m = 0.2;
  how.max_size_m = 0.8;
  const std::vector<SizeClass> classes = size_classes(curve, how);
  ASSERT_EQ(classes.size(), 2U);
  EXPECT_NEAR(classes[0].mass_percent, 50, 1e-9);  // 25 of its own, 25 below 0.2 m
  EXPECT_NEAR(classes[1].mass_percent, 50, 1e-9);
  EXPECT_NEAR(classes[0].size_m, 0.2 * std::sqrt(2), 1e-9);  // by its own rock alone
  EXPECT_NEAR(classes[1].size_m, 0.4 * std::sqrt(2), 1e-9);
  how.min_size_m = 2;
  how.max_size_m = 0;
  EXPECT_THROW(size_classes(curve, how), std::invalid_argument);
}

TEST(Sieve, ACurveThatDoesNotReach0Or100KeepsItsMass) {
  const SieveCurve curve = read_sieve(curve_file("0.2,37\n0.3,47\n0.4,56\n0.6,75\n0.85,96\n"));
  for (const int n : {1, 3, 5, 12}) {
    SieveCase how;
    how.classes = n;
    EXPECT_NEAR(total(size_classes(curve, how)), 100, 1e-9) << n;
  }
}

TEST(Sieve, AGapInTheCurveGivesNoClass) {
  const SieveCurve curve = read_sieve(curve_file("0.1,0\n0.2,50\n0.4,50\n0.8,100\n"));
  SieveCase how;
  how.classes = 3;
  const std::vector<SizeClass> classes = size_classes(curve, how);
  ASSERT_EQ(classes.size(), 2U);
  EXPECT_NEAR(total(classes), 100, 1e-9);
}

TEST(Sieve, AnotherUnitIsReportedOnceWithTheRange) {
  const std::string mm = errors_of("63,2\n125,6\n1000,100\n"),
                    shares = errors_of("0.063,0.02\n0.5,0.52\n1,1.0\n"),
                    retained = errors_of("0.063,98\n0.125,94\n1,0\n");
  EXPECT_NE(errors_of("4,4\n16,35\n48,100\n").find("up to 10 m: in mm, cm or inches, perhaps?"),
            std::string::npos);
  EXPECT_NE(mm.find("sieve.csv: size_m goes from 63 to 1000 m; up to 10 m: in mm, perhaps?"),
            std::string::npos)
      << mm;
  EXPECT_NE(shares.find("passing_percent goes from 0.02 to 1; up to 100 %: shares of 1, perhaps?"),
            std::string::npos)
      << shares;
  EXPECT_NE(retained.find("passing_percent falls from 98 to 0 as size_m rises from 0.063 to 1 m"),
            std::string::npos)
      << retained;
  for (const std::string& all : {mm, shares, retained})
    EXPECT_EQ(std::count(all.begin(), all.end(), '\n'), 0) << all;
  EXPECT_EQ(read_sieve(curve_file("0.1 m,2 %\n0.2,\"50.0\"\n0.8,100%\n")).passing_percent(0.2), 50);
}

TEST(Sieve, SharesOf1ThatPerCentFollowAreRefused) {
  for (const char* rows : {"0.1,0.1\n0.4,0.6\n1,100\n", "0.063,0.02\n0.25,0.31\n1,0.8\n1.6,100\n",
                           "1,100\n0.8,100\n0.4,0.35\n0.1,0\n0.2,0.12\n",
                           "0.1,0.04\n0.2,0.2\n0.4,55\n0.8,100\n", "0.1,0.5\n0.4,1\n0.8,100\n"})
    EXPECT_NE(errors_of(rows).find("shares of 1 and per cent in one curve, perhaps?"),
              std::string::npos)
        << rows;
  EXPECT_NE(
      errors_of("0.1,0.1\n0.4,0.6\n1,100\n")
          .find("sieve.csv:5: passing_percent jumps from 0.6 at 0.4 m, line 4, to 100 at 1 m"),
      std::string::npos);
}

TEST(Sieve, AFineEndInPerCentIsRead) {
  // Rosin-Rammler, 63.2 % at 0.5 m, n = 1.5, and the same with few sieves.
  for (const char* rows : {"0.01,0.28\n0.02,0.8\n0.05,3.1\n0.1,8.6\n0.5,63.2\n1,94.1\n2,100\n",
                           "0.005,0.1\n0.02,0.8\n1,94.1\n", "0.1,0.1\n0.2,0.6\n0.4,40\n1,100\n",
                           "0.1,0.5\n1,100\n", "0.1,0\n0.2,0.5\n0.8,100\n"})
    EXPECT_NO_THROW(read_sieve(curve_file(rows))) << rows;
  EXPECT_FALSE(find_share_jump(read_sieve(curve_file("0.1,0.1\n0.2,0.6\n0.4,40\n")).points()));
  const auto jump = find_share_jump(read_sieve(curve_file("0.1,0.5\n1,100\n")).points());
  ASSERT_TRUE(jump);
  EXPECT_FALSE(jump->certain);
  EXPECT_EQ(jump->to.line, 4);
}

TEST(Sieve, OnlyAFallThroughoutMayBeOfSharesRetained) {
  const std::string errors = errors_of("0.1,2\n0.2,6\n0.4,52\n1,1\n");
  EXPECT_EQ(errors.find("retained"), std::string::npos) << errors;
  EXPECT_NE(errors.find("sieve.csv:6: passing_percent 1 at 1 m is below the 52"),
            std::string::npos);
}

TEST(Sieve, EveryFaultWithItsLine) {
  const std::string errors = errors_of("0.1,0\n0.2,x\n-1,5\n0.3,101\n0.4,50\n0.5,40\n0.1,3\n");
  for (const char* said :
       {"sieve.csv:4:5: passing_percent is \"x\"; it must", "sieve.csv:5: size_m is -1",
        "sieve.csv:6: passing_percent is 101",
        "sieve.csv:8: passing_percent 40 at 0.5 m is below the 50 at 0.4 m of line 7",
        "sieve.csv:9: size_m 0.1 is in line 3 already"})
    EXPECT_NE(errors.find(said), std::string::npos) << said << "\n" << errors;
  EXPECT_NE(errors_of("0.1,5\n").find("1 points; a curve has at least two"), std::string::npos);
  const fs::path other = deck::fresh_folder("sieve2") / "a.csv";
  std::ofstream(other) << "mm;percent\n1;2\n";
  EXPECT_THROW(read_sieve(other), InputError);
  EXPECT_THROW(read_sieve("/no/such.csv"), InputError);
}

}  // namespace
}  // namespace dipper::cases
