#include "common/mesh/mesh_check.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/common/mesh/shapes.hpp"

namespace dipper::mesh {
namespace {

using Kind = MeshFault::Kind;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

const TriangleMesh cuboid = test::box({1, 2, 3}, {2, 4, 6});

TriangleMesh join(TriangleMesh a, const TriangleMesh& b) {
  const std::size_t n = a.vertices.size();
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const auto& t : b.triangles) a.triangles.push_back({t[0] + n, t[1] + n, t[2] + n});
  return a;
}

void flip(TriangleMesh& mesh, std::size_t facet) {
  std::swap(mesh.triangles[facet - 1][0], mesh.triangles[facet - 1][1]);
}

std::vector<std::pair<Kind, std::size_t>> faults(const TriangleMesh& mesh) {
  std::vector<std::pair<Kind, std::size_t>> kinds;
  for (const MeshFault& fault : check_mesh(mesh)) kinds.emplace_back(fault.kind, fault.facet);
  return kinds;
}

TEST(MeshCheck, SoundMeshes) {
  EXPECT_TRUE(check_mesh(cuboid).empty());
  EXPECT_TRUE(check_mesh(join(cuboid, test::box({5, 5, 5}, {6, 7, 8}))).empty());
}

TEST(MeshCheck, ShellsThatTouchInAnEdgeAreSound) {
  TriangleMesh mesh = test::box({0, 0, 0}, {1, 1, 1});
  const TriangleMesh other = test::box({1, 1, 0}, {2, 2, 1});
  // The other box's edge at (1, 1) is this one's: vertices 3 and 7.
  for (const auto& t : other.triangles) {
    const auto number = [](std::size_t i) { return i == 0 ? 3 : i == 4 ? 7 : i + 8; };
    mesh.triangles.push_back({number(t[0]), number(t[1]), number(t[2])});
  }
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  EXPECT_TRUE(check_mesh(mesh).empty());
}

TEST(MeshCheck, AHoleIsItsThreeEdges) {
  TriangleMesh mesh = cuboid;
  mesh.triangles.erase(mesh.triangles.begin());  // {0, 2, 1}; facets move down by one
  EXPECT_THAT(faults(mesh),
              UnorderedElementsAre(std::pair(Kind::open_edge, 1U), std::pair(Kind::open_edge, 4U),
                                   std::pair(Kind::open_edge, 8U)));
  EXPECT_EQ(check_mesh(mesh)[0].message,
            "facet 1: not closed: the edge (2, 2, 3) to (1, 4, 3) has no second facet");
}

TEST(MeshCheck, ATurnedFacetAndAHole) {
  TriangleMesh cube = test::box({0, 0, 0}, {1, 1, 1});
  flip(cube, 4);
  EXPECT_FALSE(check_mesh(cube).empty());
  cube.triangles.pop_back();
  EXPECT_FALSE(check_mesh(cube).empty());
}

TEST(MeshCheck, DegenerateFacets) {
  TriangleMesh point = cuboid;
  point.triangles.push_back({3, 3, 5});
  EXPECT_THAT(faults(point), UnorderedElementsAre(std::pair(Kind::degenerate, 13U)));

  // A sliver that splits an edge: closed, and without area.
  TriangleMesh sliver = cuboid;
  sliver.vertices.push_back({1.5, 2, 3});  // on the edge 0-1, of facets 1 and 5
  sliver.triangles[0] = {0, 2, 8};
  sliver.triangles.push_back({8, 2, 1});
  sliver.triangles.push_back({0, 8, 1});
  EXPECT_THAT(faults(sliver), UnorderedElementsAre(std::pair(Kind::degenerate, 14U)));
}

TEST(MeshCheck, DuplicateFacetsEvenWhenTurned) {
  TriangleMesh mesh = cuboid;
  mesh.triangles.push_back({5, 3, 1});
  EXPECT_THAT(faults(mesh), UnorderedElementsAre(std::pair(Kind::duplicate, 13U)));
  EXPECT_THAT(check_mesh(mesh)[0].message, HasSubstr("has the corners of facet 11"));
}

TEST(MeshCheck, FlippedFacetsAreTheFewer) {
  TriangleMesh mesh = cuboid;
  flip(mesh, 1);
  flip(mesh, 12);
  EXPECT_THAT(faults(mesh),
              UnorderedElementsAre(std::pair(Kind::flipped, 1U), std::pair(Kind::flipped, 12U)));
}

TEST(MeshCheck, InvertedShellBesideASoundOne) {
  TriangleMesh other = test::box({5, 5, 5}, {6, 7, 8});
  for (std::size_t i = 1; i <= 12; ++i) flip(other, i);
  EXPECT_NEAR(volume(other), -6, 1e-12);
  const auto found = check_mesh(join(cuboid, other));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].kind, Kind::inverted);
  EXPECT_EQ(found[0].facet, 13U);
  EXPECT_THAT(found[0].message, HasSubstr("faces inwards (volume -6 m3)"));
}

TEST(MeshCheck, AFinOnAnEdge) {
  TriangleMesh mesh = cuboid;
  mesh.vertices.push_back({0, 0, 0});
  mesh.triangles.push_back({0, 1, 8});
  EXPECT_THAT(faults(mesh), UnorderedElementsAre(std::pair(Kind::crowded_edge, 13U),
                                                 std::pair(Kind::open_edge, 13U),
                                                 std::pair(Kind::open_edge, 13U)));
}

TEST(MeshCheck, ThinFacetsAreReportedWithTheirAngle) {
  TriangleMesh mesh = cuboid;  // facet 1, on the floor, with a corner close above one of its edges
  const Triangle floor = mesh.corners(0);
  mesh.vertices.push_back((floor[0] + floor[1]) / 2 + 1e-4 * (floor[2] - floor[0]));
  const auto t = mesh.triangles[0];
  mesh.triangles[0] = {t[0], t[1], 8};
  mesh.triangles.push_back({t[1], t[2], 8});
  mesh.triangles.push_back({t[2], t[0], 8});
  EXPECT_TRUE(check_mesh(mesh).empty());
  const auto thin = check_angles(mesh, 0.01);
  ASSERT_EQ(thin.size(), 1U);
  EXPECT_EQ(thin[0].facet, 1U);
  EXPECT_THAT(thin[0].message, HasSubstr("facet 1: its smallest angle is 0.0"));
  EXPECT_THAT(thin[0].message, HasSubstr("LIGGGHTS takes 0.57 deg and more"));
  EXPECT_TRUE(check_angles(cuboid, 0.01).empty());
}

TEST(MeshCheck, SeveralFaultsAtOnceInTheOrderOfTheFile) {
  TriangleMesh mesh = cuboid;
  flip(mesh, 3);
  mesh.triangles.push_back(mesh.triangles[6]);
  mesh.triangles.push_back({1, 1, 1});
  EXPECT_THAT(faults(mesh),
              testing::ElementsAre(std::pair(Kind::flipped, 3U), std::pair(Kind::duplicate, 13U),
                                   std::pair(Kind::degenerate, 14U)));
}

}  // namespace
}  // namespace dipper::mesh
