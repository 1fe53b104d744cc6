#include "analysis/rock/struck_volume.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/mesh/stl.hpp"
#include "tests/analysis/tray.hpp"
#include "tests/places.hpp"

namespace dipper::analysis::rock {
namespace {

using Eigen::Vector3d;

TEST(StruckVolume, ABoxOfThinPlatesHoldsItsCavity) {
  const StruckVolume s = struck_volume(tray());
  EXPECT_NEAR(s.volume_m3, 3.0, 0.03);
  EXPECT_GT(s.up.x(), 0.98);
  EXPECT_NEAR(s.water.sides_m().y(), 1.0, 0.08);
}

TEST(StruckVolume, TurnedOnItsSideItHoldsNothing) {
  EXPECT_NEAR(water_held(tray(), Vector3d(-1, 0, 0), 0.05), 0, 1e-9);
  EXPECT_NEAR(water_held(tray(), Vector3d(0, 0, 1), 0.05), 0, 1e-9);
  // At 45 degrees the surface goes from the lip to the rear: half of a wedge 1.5 m high is lost.
  EXPECT_NEAR(water_held(tray(), Vector3d(1, 0, 1).normalized(), 0.02), 3.0 - 1.5 * 1.5 / 2, 0.06);
}

TEST(StruckVolume, OfTheDipperIsWhatItsFileSays) {
  mesh::TriangleMesh mesh = mesh::read_stl(test::source() / "meshes/dipper.stl");
  const mesh::TriangleMesh door = mesh::read_stl(test::source() / "meshes/door.stl");
  for (std::size_t t = 0; t < door.triangles.size(); ++t) {
    mesh::Triangle corners = door.corners(t);
    for (auto& c : corners) c.z() += 1.5;  // the hinge (docs/frames.md)
    mesh.add_loose(corners);
  }
  const StruckVolume s = struck_volume(mesh);
  EXPECT_NEAR(s.volume_m3, 42, 0.42);  // meshes/dipper.yaml, 1 %
  EXPECT_GT(s.up.x(), 0.7);
}

}  // namespace
}  // namespace dipper::analysis::rock
