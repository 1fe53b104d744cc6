#include "machine/teeth_path.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace dipper::machine {
namespace {

const Vector2d kSaddle{9.2, 10.8};
constexpr double kReach_m = 15.5;

/// A plane face at an angle, its toe 13.5 m out, 12 m high.
TeethPath plane_face(double angle_rad) {
  return {{0, 0}, {13.5, 0}, {13.5 + 12 / std::tan(angle_rad), 12}, {45, 12}};
}

Cut cut() {
  Cut c;
  c.start = {13, 0.4};
  c.depth_m = 1.2;
  c.exit_z_m = 8;
  return c;
}

/// Of a dipper that is never in the way of its own teeth.
Vector2d clear_heel(const Vector2d& tip) { return tip + Vector2d(0, 1e3); }

TEST(TeethPath, KeepsItsDepthUnderAPlaneFace) {
  const double angle = 35 * M_PI / 180;
  const TeethPath path = cut_path(plane_face(angle), cut(), kSaddle, 100, clear_heel);
  for (const Vector2d& p : path) {
    if (p.y() < 1 || p.y() > 7.5) continue;
    // Distance to the line through the toe.
    const double depth = (p.x() - 13.5) * std::sin(angle) - p.y() * std::cos(angle);
    EXPECT_NEAR(depth, 1.2, 0.02) << p.transpose();
  }
  EXPECT_EQ(path.front(), Vector2d(13, 0.4));
  EXPECT_NEAR(path.back().y(), 8, 0.2);
}

TEST(TeethPath, GoesUpOnTheCircleWhereTheCrowdIsOut) {
  const TeethPath path = cut_path(plane_face(0.5), cut(), kSaddle, kReach_m, clear_heel);
  double farthest = 0;
  for (const Vector2d& p : path) farthest = std::max(farthest, (p - kSaddle).norm());
  EXPECT_LE(farthest, kReach_m + 1e-9);
  EXPECT_GT(farthest, kReach_m - 0.2);
  EXPECT_NEAR(path.back().y(), 8, 0.2);
}

TEST(TeethPath, NeverGoesDownAndRisesWithTheFloor) {
  Cut c = cut();
  c.floor_rise = 0.1;
  TeethPath face = plane_face(0.6);
  face.insert(face.begin() + 1, {12, 2});  // a heap in front of the toe
  const TeethPath path = cut_path(face, c, kSaddle, kReach_m, clear_heel);
  for (std::size_t i = 1; i < path.size(); ++i) EXPECT_GE(path[i].y(), path[i - 1].y());
  EXPECT_THROW(cut_path(face, c, {9.2, 40}, kReach_m, clear_heel), std::invalid_argument);
}

TEST(TeethPath, RisesWhereTheHeelWouldGoUnderTheFloor) {
  // 4.6 m behind the teeth, as high as they are 15 m out, and the lower the farther out.
  const auto heel = [](const Vector2d& tip) -> Vector2d {
    return tip - Vector2d(4.6, 4.6 * 0.07 * (tip.x() - 15));
  };
  const TeethPath far = {{0, 0}, {18, 0}, {26, 8}, {45, 8}};
  const TeethPath free = cut_path(far, cut(), kSaddle, kReach_m, clear_heel),
                  path = cut_path(far, cut(), kSaddle, kReach_m, heel);
  double lowest = 1e3, lowest_free = 1e3;
  for (const Vector2d& p : path) lowest = std::min(lowest, heel(p).y());
  for (const Vector2d& p : free) lowest_free = std::min(lowest_free, heel(p).y());
  EXPECT_GT(lowest, 0.4 - 0.02);
  EXPECT_LT(lowest_free, 0);
  EXPECT_EQ(path.front(), free.front());
}

TEST(TeethPath, ASplineIsEvenAndKeepsItsEnds) {
  const TeethPath path = spline({{0, 0}, {4, 0}, {4, 3}, {10, 5}});
  EXPECT_LT((path.front() - Vector2d(0, 0)).norm(), 1e-6);
  EXPECT_LT((path.back() - Vector2d(10, 5)).norm(), 1e-6);
  const double step = (path[1] - path[0]).norm();
  for (std::size_t i = 1; i < path.size(); i += 100)
    EXPECT_NEAR((path[i] - path[i - 1]).norm(), step, 1e-3 * step);
  EXPECT_LT((at_fraction(path, 0.5) - path[path.size() / 2]).norm(), step);
}

}  // namespace
}  // namespace dipper::machine
