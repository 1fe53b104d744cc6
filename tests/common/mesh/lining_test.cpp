#include "common/mesh/lining.hpp"

#include <gtest/gtest.h>

#include "common/mesh/mesh_check.hpp"
#include "common/mesh/stl.hpp"
#include "tests/places.hpp"

namespace dipper::mesh {
namespace {

TriangleMesh dipper_mesh() { return read_stl(test::source() / "meshes/dipper.stl"); }

Box cavity() {
  Box box;
  box.min_m = {0, -2, -1.5};
  box.max_m = {4, 2, 1.5};
  return box;
}

// Sides of 4 x 3 m, slanted in front: the section's perimeter is 2 (4 + 3) m at the floor's 4 m and
// the roof's 3 m; the layer takes the corners once.
TEST(Lining, AllSidesLoseWhatTheirAreaTimesTheThicknessSays) {
  const double t = 0.05;
  const Lining lined = line_dipper(dipper_mesh(), cavity(), t, LinedFaces::all_sides);
  EXPECT_TRUE(check_mesh(lined.mesh).empty());
  // Cavity: width w, height h, mean length 3.5: volume 3.5 w h, so 3.5 (4 3 - (4 - 2t)(3 - 2t)),
  // less what the slanted lip adds or takes: the front moves with its edges, second order in t.
  const double expected = 3.5 * (12 - (4 - 2 * t) * (3 - 2 * t));
  EXPECT_NEAR(lined.layer.volume_m3, expected, 0.01 * expected);
  EXPECT_NEAR(lined.layer.com_m.y(), 0, 5e-3);  // facets at the lip are not quite symmetric
}

TEST(Lining, TheFloorRisesByTheThickness) {
  const Lining lined = line_dipper(dipper_mesh(), cavity(), 0.2, LinedFaces::floor);
  EXPECT_TRUE(check_mesh(lined.mesh).empty());
  EXPECT_NEAR(lined.layer.volume_m3, 4.0 * 4.0 * 0.2, 0.05 * 3.2);
  EXPECT_NEAR(lined.layer.com_m.z(), -1.4, 0.01);
  EXPECT_NEAR(lined.layer.com_m.x(), 2.0, 0.1);
  // A flat plate's moment about x: V (w^2 + t^2)/12.
  EXPECT_NEAR(lined.layer.inertia_m5(0, 0), 3.2 * (16 + 0.04) / 12, 0.05 * 4.3);
  const Box before = bounding_box(dipper_mesh()), after = bounding_box(lined.mesh);
  EXPECT_EQ(before.min_m, after.min_m);  // nothing moves on the outside, nor the teeth
  EXPECT_EQ(before.max_m, after.max_m);
}

TEST(Lining, RefusesWhatDoesNotFitOrHasNoPlates) {
  EXPECT_THROW(line_dipper(dipper_mesh(), cavity(), 0.8, LinedFaces::floor), std::invalid_argument);
  EXPECT_THROW(line_dipper(dipper_mesh(), cavity(), 0, LinedFaces::floor), std::invalid_argument);
  Box elsewhere = cavity();
  elsewhere.min_m.z() += 20;
  elsewhere.max_m.z() += 20;
  EXPECT_THROW(line_dipper(dipper_mesh(), elsewhere, 0.1, LinedFaces::floor),
               std::invalid_argument);
}

}  // namespace
}  // namespace dipper::mesh
