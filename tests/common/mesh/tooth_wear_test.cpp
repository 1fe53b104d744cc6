#include "common/mesh/tooth_wear.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "common/mesh/mesh_check.hpp"
#include "common/mesh/stl.hpp"
#include "tests/common/mesh/shapes.hpp"
#include "tests/places.hpp"

namespace dipper::mesh {
namespace {

TriangleMesh dipper_mesh() { return read_stl(test::source() / "meshes/dipper.stl"); }

// meshes/dipper.yaml's teeth: six wedges of 0.6 m, 0.34 x 0.18 m at the root, 0.22 x 0.04 m at the
// tip.
constexpr double kLength = 0.6, kTip = 4.605;

/// Volume [m3] in front of the cut: width and thickness are linear along a tooth, so Simpson's rule
/// is exact.
double lost(double wear) {
  const auto section = [](double from_tip) {
    const double s = from_tip / kLength;
    return (0.22 + s * 0.12) * (0.04 + s * 0.14);
  };
  return 6 * wear / 6 * (section(0) + 4 * section(wear / 2) + section(wear));
}

Eigen::Vector3d normal(const TriangleMesh& mesh, std::size_t i) {
  const Triangle t = mesh.corners(i);
  return (t[1] - t[0]).cross(t[2] - t[0]).normalized();
}

// The rake is the angle of the line from the heel to the tips (Svanberg et al. 2021, Fig. 4b), and
// the dipper hangs by its x.
TEST(Dipper, HasItsTipsAsLowAsItsHeel) {
  double heel = 0, tip = 0;
  for (const Eigen::Vector3d& v : dipper_mesh().vertices) {
    if (v.x() < 1e-6) heel = std::min(heel, v.z());
    if (v.x() > kTip - 1e-6) tip = std::min(tip, v.z());
  }
  EXPECT_DOUBLE_EQ(tip, heel);
  EXPECT_LT(heel, -1.5);
}

TEST(ToothWear, CutsTheTeethOffAndNothingElse) {
  const TriangleMesh whole = dipper_mesh();
  for (const double wear : {0.001, 0.1, 0.4, 0.539}) {
    const TriangleMesh worn = wear_teeth(whole, wear);
    EXPECT_TRUE(check_mesh(worn).empty());
    EXPECT_NEAR(bounding_box(worn).max_m.x(), kTip - wear, 1e-6);
    EXPECT_NEAR(volume(whole) - volume(worn), lost(wear), 1e-6 + 1e-4 * lost(wear)) << wear;
    // No facet turns: planes of a wedge stay the planes they are.
    for (std::size_t i = 0; i < whole.triangles.size(); ++i) {
      EXPECT_GT(normal(whole, i).dot(normal(worn, i)), 1 - 1e-6) << "facet " << i;
    }
    for (std::size_t v = 0; v < whole.vertices.size(); ++v) {
      const bool tip = whole.vertices[v].x() > 4.1;
      EXPECT_EQ(whole.vertices[v] == worn.vertices[v], !tip);
    }
  }
}

TEST(ToothWear, LeavesTeethThatEndBehindTheCut) {
  TriangleMesh mesh = dipper_mesh();
  for (Eigen::Vector3d& v : mesh.vertices) {
    if (v.x() > 4.5 && v.y() > 0) v.x() -= 0.2;  // three of the six have been replaced late
  }
  const TriangleMesh worn = wear_teeth(mesh, 0.1);
  double left = 0, right = 0;
  for (const Eigen::Vector3d& v : worn.vertices) {
    (v.y() > 0 ? left : right) = std::max(v.y() > 0 ? left : right, v.x());
  }
  EXPECT_NEAR(left, kTip - 0.2, 1e-6);
  EXPECT_NEAR(right, kTip - 0.1, 1e-6);
}

TEST(ToothWear, RefusesMoreThanTheTeethHaveAndSaysHowMuch) {
  for (const double wear : {0.0, -0.1, 0.55, 0.62, 2.0}) {
    try {
      wear_teeth(dipper_mesh(), wear);
      ADD_FAILURE() << wear;
    } catch (const std::invalid_argument& e) {
      EXPECT_NE(std::string(e.what()).find("<= 0.54"), std::string::npos) << e.what();
    }
  }
  // Not a wedge along x: its front edges lead up and aside only, and back to eight corners of none.
  EXPECT_THROW(wear_teeth(test::sphere(1, 6), 0.3), std::invalid_argument);
}

TEST(ToothWear, ShortensABoxByItsEdges) {
  const TriangleMesh worn = wear_teeth(test::box({0, 0, 0}, {2, 1, 1}), 0.5);
  EXPECT_TRUE(check_mesh(worn).empty());
  EXPECT_NEAR(volume(worn), 1.5, 1e-12);
}

}  // namespace
}  // namespace dipper::mesh
