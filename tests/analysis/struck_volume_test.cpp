#include "analysis/struck_volume.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "coupler/mesh/stl.hpp"

namespace dipper {
namespace {

using Eigen::Vector3d;

/// A box-shaped solid between two corners.
void add_block(TriangleMesh& mesh, const Vector3d& a, const Vector3d& b) {
  const auto p = [&](int k) {
    return Vector3d((k & 1) != 0 ? b.x() : a.x(), (k & 2) != 0 ? b.y() : a.y(),
                    (k & 4) != 0 ? b.z() : a.z());
  };
  const int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                           {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& f : faces) {
    mesh.add_loose({p(f[0]), p(f[1]), p(f[2])});
    mesh.add_loose({p(f[0]), p(f[2]), p(f[3])});
  }
}

/// Five plates 4 cm thick around a cavity of 2 x 1 x 1.5 m that opens to +x.
TriangleMesh tray() {
  TriangleMesh m;
  constexpr double t = 0.04;
  add_block(m, {-t, -0.5 - t, -0.75 - t}, {0, 0.5 + t, 0.75 + t});
  add_block(m, {-t, -0.5 - t, -0.75 - t}, {2, -0.5, 0.75 + t});
  add_block(m, {-t, 0.5, -0.75 - t}, {2, 0.5 + t, 0.75 + t});
  add_block(m, {-t, -0.5 - t, -0.75 - t}, {2, 0.5 + t, -0.75});
  add_block(m, {-t, -0.5 - t, 0.75}, {2, 0.5 + t, 0.75 + t});
  return m;
}

TEST(StruckVolume, ABoxOfThinPlatesHoldsItsCavity) {
  const StruckVolume s = struck_volume(tray());
  EXPECT_NEAR(s.volume_m3, 3.0, 0.03);
  EXPECT_GT(s.up.x(), 0.98);
  EXPECT_NEAR(s.water.max.y() - s.water.min.y(), 1.0, 0.08);
}

TEST(StruckVolume, TurnedOnItsSideItHoldsNothing) {
  EXPECT_NEAR(water_held(tray(), Vector3d(-1, 0, 0), 0.05), 0, 1e-9);
  EXPECT_NEAR(water_held(tray(), Vector3d(0, 0, 1), 0.05), 0, 1e-9);
  // At 45 degrees the surface goes from the lip to the rear: half of a wedge 1.5 m high is lost.
  EXPECT_NEAR(water_held(tray(), Vector3d(1, 0, 1).normalized(), 0.02), 3.0 - 1.5 * 1.5 / 2, 0.06);
}

TEST(StruckVolume, OfTheDipperIsWhatItsFileSays) {
  TriangleMesh mesh = read_stl(DIPPER_MESHES "/dipper.stl");
  const TriangleMesh door = read_stl(DIPPER_MESHES "/door.stl");
  for (std::size_t t = 0; t < door.triangles.size(); ++t) {
    Triangle corners = door.corners(t);
    for (auto& c : corners) c.z() += 1.5;  // the hinge (docs/frames.md)
    mesh.add_loose(corners);
  }
  const StruckVolume s = struck_volume(mesh);
  EXPECT_NEAR(s.volume_m3, 42, 0.42);  // meshes/dipper.yaml, 1 %
  EXPECT_GT(s.up.x(), 0.7);
}

}  // namespace
}  // namespace dipper
