#include "analysis/report/slice.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/common/mesh/shapes.hpp"

namespace dipper::analysis::report {
namespace {

/// A box of 4 x 4 x 3 m as dipper, turned to the left by 90 degrees and tipped lip up by 30.
struct Scene {
  std::vector<ReplayWall> walls = {{"dipper", test::box({0, -2, -1.5}, {4, 2, 1.5})}};
  ReplayFrame frame;
  Scene() {
    frame.walls.resize(1);
    auto& s = frame.walls[0];
    s.X_WB.R = Quaterniond(Eigen::AngleAxisd(M_PI / 2, Vector3d::UnitZ()) *
                           Eigen::AngleAxisd(-M_PI / 6, Vector3d::UnitY()));
    s.X_WB.p = {3, 5, 7};
    s.V_WB_W.v = {0, 1, 0};
    s.V_WB_W.w = {0, 0, 0.5};
  }
  void add(const Vector3d& p_B, const Vector3d& v_W) {
    ReplaySphere sphere;
    sphere.radius_m = 0.2f;
    sphere.p_m = (frame.walls[0].X_WB * p_B).cast<float>();
    sphere.v_m_s = v_W.cast<float>();
    frame.spheres.push_back(sphere);
  }
};

TEST(Slice, KeepsWhatLiesWithinHalfAMetreOfTheMiddle) {
  Scene scene;
  for (const double y : {-0.6, -0.4, 0.0, 0.4, 0.6}) scene.add({2, y, 0}, {0, 0, 0});
  const Slice s = slice(scene.frame, scene.walls, 0);
  ASSERT_EQ(s.spheres.size(), 3u);
  EXPECT_NEAR(s.spheres.front().p_B.y(), 0.4, 1e-5);  // seen from the right: the left is far
  EXPECT_NEAR(s.spheres.back().p_B.y(), -0.4, 1e-5);
}

TEST(Slice, OutAndUpAreThoseOfTheWorld) {
  Scene scene;
  scene.add({2, 0, 0}, {0, 0, 0});
  const Slice s = slice(scene.frame, scene.walls, 0);
  ASSERT_EQ(s.spheres.size(), 1u);
  EXPECT_NEAR(s.spheres[0].out, 2 * std::cos(M_PI / 6), 1e-5);
  EXPECT_NEAR(s.spheres[0].up, 2 * std::sin(M_PI / 6), 1e-5);
}

TEST(Slice, SpeedIsAgainstTheTurningDipper) {
  Scene scene;
  const Vector3d p_B(2, 0, 0);
  const auto& d = scene.frame.walls[0];
  const Vector3d arm = d.X_WB.R * p_B;
  scene.add(p_B, d.V_WB_W.v + d.V_WB_W.w.cross(arm));                          // rides along
  scene.add(p_B, d.V_WB_W.v + d.V_WB_W.w.cross(arm) + Vector3d(0.3, 0, 0.4));  // slides
  const Slice s = slice(scene.frame, scene.walls, 0);
  ASSERT_EQ(s.spheres.size(), 2u);
  EXPECT_NEAR(s.spheres[0].relative_speed, 0, 1e-5);
  EXPECT_NEAR(s.spheres[1].relative_speed, 0.5, 1e-5);
}

TEST(Slice, SectionOfTheBoxIsItsOutline) {
  const Scene scene;
  const Slice s = slice(scene.frame, scene.walls, 0);
  double length = 0;
  for (const auto& w : s.walls) length += std::hypot(w.to[0] - w.from[0], w.to[1] - w.from[1]);
  EXPECT_NEAR(length, 2 * (4 + 3), 1e-9);
}

TEST(Slice, LeavesOutWhatIsFarAway) {
  Scene scene;
  scene.add({30, 0, 0}, {0, 0, 0});
  EXPECT_TRUE(slice(scene.frame, scene.walls, 0).spheres.empty());
}

}  // namespace
}  // namespace dipper::analysis::report
