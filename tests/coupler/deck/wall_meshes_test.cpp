#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <cmath>

#include "common/mesh/mass_properties.hpp"
#include "common/mesh/mesh_check.hpp"
#include "common/mesh/signed_distance.hpp"
#include "common/mesh/stl.hpp"
#include "coupler/deck/pile_shape.hpp"
#include "coupler/deck/pile_walls.hpp"
#include "tests/coupler/deck/quick_case.hpp"
#include "tests/places.hpp"

namespace dipper::deck {
namespace {

using Eigen::Vector3d;
const std::filesystem::path kMeshes = test::source() / "meshes";

TEST(WallMeshes, AreClosedAndMatchTheirYaml) {
  for (const char* name : {"dipper", "door", "truck"}) {
    const mesh::TriangleMesh mesh = mesh::read_stl(kMeshes / (std::string(name) + ".stl"));
    const YAML::Node y = YAML::LoadFile(kMeshes / (std::string(name) + ".yaml"));
    const mesh::MassProperties m = mesh::mass_properties(mesh);
    EXPECT_TRUE(mesh::check_mesh(mesh).empty()) << name;
    EXPECT_NEAR(m.volume_m3, y["solid_volume_m3"].as<double>(), 1e-4 * m.volume_m3) << name;
    EXPECT_NEAR(m.area_m2, y["surface_area_m2"].as<double>(), 1e-4 * m.area_m2) << name;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        const mesh::Triangle t = mesh.corners(i);
        const Vector3d a = t[(k + 1) % 3] - t[k], b = t[(k + 2) % 3] - t[k];
        EXPECT_GT(std::acos(a.normalized().dot(b.normalized())), 2 * M_PI / 180) << name;
      }
  }
}

TEST(WallMeshes, DipperHolds42CubicMetres) {
  const YAML::Node y = YAML::LoadFile(kMeshes / "dipper.yaml");
  EXPECT_DOUBLE_EQ(y["struck_volume_m3"].as<double>(), 42);
  const auto lo = y["cavity"]["min_m"].as<std::vector<double>>();
  const auto hi = y["cavity"]["max_m"].as<std::vector<double>>();
  const mesh::TriangleMesh mesh = mesh::read_stl(kMeshes / "dipper.stl");
  // The cavity is free, its walls are 0.18 m of solid: just inside, just outside, behind the plate.
  const Vector3d c(1.5, (lo[1] + hi[1]) / 2, (lo[2] + hi[2]) / 2);
  EXPECT_NEAR(mesh::signed_distance(mesh, c), -1.5, 1e-9);
  for (const double side : {lo[2], hi[2]}) {
    const double out = side < 0 ? -1 : 1;
    EXPECT_GT(mesh::signed_distance(mesh, {1.5, 0, side + out * 0.09}), 0);
    EXPECT_LT(mesh::signed_distance(mesh, {1.5, 0, side + out * 0.19}), 0);
  }
}

TEST(WallMeshes, DoorLeavesNoGapForARock) {
  // In B: the hinge is at (0, 0, 1.5). The gap to the rim is a fifth of a 0.1 m sphere's radius.
  const mesh::TriangleMesh door = mesh::read_stl(kMeshes / "door.stl");
  const Vector3d hinge(0, 0, 1.5);
  for (const double y : {-2.1, 0.0, 2.1})
    for (const double z : {-1.6, 0.0, 1.6})
      EXPECT_NEAR(mesh::signed_distance(door, Vector3d(0, y, z) - hinge), -0.02, 1e-6);
}

TEST(PileShape, IsTheTrapezoid) {
  cases::Case c = quick_case();
  c.pile.face_angle_deg = 45;
  const PileShape p = pile_shape(c);
  EXPECT_NEAR(p.pour_run_m, 8, 1e-12);
  EXPECT_NEAR(p.rear_x_m, 23, 1e-12);
  EXPECT_NEAR(p.volume_m3, 8 * (8 * 8 / 2 + 8 * 2), 1e-9);
}

TEST(PileShape, OfAProfileIsABoxBehindItsToe) {
  cases::Case c = quick_case();
  c.pile.profile = "scan.csv";
  c.pile.outline_m = {{12, 0}, {12, 3}, {15, 7}, {20, 6}};
  const PileShape p = pile_shape(c);
  EXPECT_EQ(p.toe_x_m, 12);
  EXPECT_EQ(p.rear_x_m, 20);
  EXPECT_EQ(p.height_m, 7);
  EXPECT_EQ(p.pour_run_m, 0);
  EXPECT_NEAR(p.volume_m3, 8 * 8 * 7, 1e-9);
  EXPECT_NEAR(p.pour_height_m, 7 * kPourExcess * kSettledFraction / kPouredFraction, 1e-9);
  EXPECT_EQ(bench_outline(c), c.pile.outline_m);
  // An upright form wall at the toe, as high as the pour; then walls that follow the profile.
  double front_top = 0;
  for (const Vector3d& v : funnel_walls(c).vertices)
    if (std::abs(v.x() - 12) < 1e-9) front_top = std::max(front_top, v.z());
  EXPECT_NEAR(front_top, p.pour_height_m, 1e-9);
  double top = 0, top_of_front = 0;
  for (const Vector3d& v : bench_walls(c).vertices) {
    top = std::max(top, v.z());
    if (v.x() < 11.5) top_of_front = std::max(top_of_front, v.z());
  }
  EXPECT_NEAR(top, 8, 1e-9);
  EXPECT_GT(top_of_front, 3);
  EXPECT_LT(top_of_front, 5.5);  // the margin and a facet over the upright part
}

TEST(PileWalls, StayLowInFrontOfTheBench) {
  const cases::Case c = quick_case();
  double front = 1e9, top_over_toe = 0, top = 0;
  for (const Vector3d& p : bench_walls(c).vertices) {
    front = std::min(front, p.x());
    top = std::max(top, p.z());
    if (p.x() < c.pile.toe_x_m + 1) top_over_toe = std::max(top_over_toe, p.z());
  }
  EXPECT_NEAR(front, c.pile.toe_x_m - 1, 1e-9);
  EXPECT_NEAR(top, c.pile.height_m + 1, 1e-9);
  EXPECT_LT(top_over_toe, 4);
}

}  // namespace
}  // namespace dipper::deck
