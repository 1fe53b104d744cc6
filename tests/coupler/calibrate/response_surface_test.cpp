#include "coupler/calibrate/response_surface.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

namespace dipper::calibrate {
namespace {

Point point(double a, double b) { return Eigen::Vector2d(a, b); }

double known(const Point& x) {
  return 30 + 4 * x[0] + 2 * x[1] - 1.5 * x[0] * x[0] + 0.5 * x[0] * x[1] - 0.3 * x[1] * x[1];
}

TEST(CompositeDesign, HasCornersFacesAndCentre) {
  EXPECT_EQ(composite_design(1).size(), 3U);
  EXPECT_EQ(composite_design(2).size(), 9U);
  EXPECT_EQ(composite_design(3).size(), 15U);
  EXPECT_THROW(composite_design(0), std::invalid_argument);
  EXPECT_THROW(composite_design(4), std::invalid_argument);
}

TEST(ResponseSurface, FindsAQuadraticExactly) {
  const std::vector<Point> x = composite_design(2);
  std::vector<double> y;
  for (const Point& p : x) y.push_back(known(p));
  const ResponseSurface s(x, y);
  const Point p = point(0.37, -0.62);
  EXPECT_NEAR(s.at(p).value, known(p), 1e-10);
  EXPECT_NEAR(s.residual_sigma(), 0, 1e-10);
  EXPECT_EQ(s.degrees_of_freedom(), 3);
  constexpr double h = 1e-6;
  EXPECT_NEAR(s.gradient(p)[0], (known(p + point(h, 0)) - known(p - point(h, 0))) / 2 / h, 1e-6);
  EXPECT_NEAR(s.gradient(p)[1], (known(p + point(0, h)) - known(p - point(0, h))) / 2 / h, 1e-6);
}

/// The standard error it states is the scatter that repeated searches have, and the seeds' own
/// scatter is separated from it.
TEST(ResponseSurface, StatedErrorIsTheScatterOfRepeatedSearches) {
  std::mt19937 draw(7);
  std::normal_distribution<double> noise(0, 0.8);
  const Point p = point(0.5, 0.5);
  double squares = 0, stated = 0, seeds = 0;
  constexpr int kSearches = 400;
  for (int k = 0; k < kSearches; ++k) {
    std::vector<Point> x;
    std::vector<double> y;
    for (const Point& q : composite_design(2))
      for (int seed = 0; seed < 2; ++seed) {
        x.push_back(q);
        y.push_back(known(q) + noise(draw));
      }
    const ResponseSurface s(x, y);
    squares += std::pow(s.at(p).value - known(p), 2);
    stated += std::pow(s.at(p).sigma, 2);
    seeds += std::pow(*seed_sigma(x, y), 2);
  }
  EXPECT_NEAR(std::sqrt(stated / squares), 1, 0.1);
  EXPECT_NEAR(std::sqrt(seeds / kSearches), 0.8, 0.03);
}

TEST(ResponseSurface, SeedSigmaNeedsRepeats) {
  EXPECT_FALSE(seed_sigma({point(0, 0), point(1, 0)}, {1, 2}).has_value());
  EXPECT_NEAR(*seed_sigma({point(0, 0), point(1, 0), point(0, 0)}, {1, 7, 3}), std::sqrt(2), 1e-12);
}

TEST(ResponseSurface, NearestWithTheTarget) {
  std::vector<double> y;
  for (const Point& p : composite_design(2)) y.push_back(20 + 3 * p[0] + 4 * p[1]);
  const ResponseSurface plane(composite_design(2), y);
  // A plane's nearest point is its foot.
  const auto foot = nearest_with(plane, 22.5, point(0, 0));
  ASSERT_TRUE(foot.has_value());
  EXPECT_NEAR((*foot)[0], 0.3, 1e-5);
  EXPECT_NEAR((*foot)[1], 0.4, 1e-5);
  // Against the end of a range it goes on along it; 27 is the corner's, 28 nobody's.
  const auto far = nearest_with(plane, 26, point(0, 0));
  ASSERT_TRUE(far.has_value());
  EXPECT_NEAR(plane.at(*far).value, 26, 1e-5);
  EXPECT_LE(far->cwiseAbs().maxCoeff(), 1 + 1e-12);
  EXPECT_FALSE(nearest_with(plane, 28, point(0, 0)).has_value());
}

TEST(ResponseSurface, NeutralLineKeepsTheValue) {
  std::vector<double> y;
  for (const Point& p : composite_design(2)) y.push_back(known(p));
  const ResponseSurface s(composite_design(2), y);
  const auto x = nearest_with(s, 31, point(0, 0));
  ASSERT_TRUE(x.has_value());
  const auto lines = neutral_directions(s, *x);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NEAR(lines[0].norm(), 1, 1e-12);
  EXPECT_NEAR(lines[0].dot(s.gradient(*x)), 0, 1e-10);
  for (const double way : {-1.0, 1.0}) {
    const Point end = follow(s, *x, way * lines[0]);
    EXPECT_NEAR(s.at(end).value, 31, 1e-3);
    EXPECT_GT(end.cwiseAbs().maxCoeff(), 0.97);  // it ends at an end of a range
  }
  EXPECT_TRUE(neutral_directions(ResponseSurface({Point::Constant(1, -1), Point::Constant(1, 0),
                                                  Point::Constant(1, 1), Point::Constant(1, 1)},
                                                 {1, 2, 3, 3}),
                                 Point::Constant(1, 0))
                  .empty());
}

TEST(ResponseSurface, RefusesTooLittle) {
  EXPECT_THROW(ResponseSurface({}, {}), std::invalid_argument);
  EXPECT_THROW(ResponseSurface({point(0, 0), point(0, 1)}, {1, 2}), std::invalid_argument);
  const std::vector<Point> same(9, point(0, 0));
  EXPECT_THROW(ResponseSurface(same, std::vector<double>(9, 1.0)), std::invalid_argument);
}

}  // namespace
}  // namespace dipper::calibrate
