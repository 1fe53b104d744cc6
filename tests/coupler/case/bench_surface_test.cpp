#include "coupler/case/bench_surface.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "coupler/deck/bench_cut.hpp"
#include "tests/coupler/deck/height_field.hpp"

namespace dipper::cases {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::vector<double> kX = {10, 11.3, 12, 14, 15.1, 16}, kY = {-3, -1.2, 0.1, 1, 3};

double plane(double x, double y) { return 1 + 0.5 * (x - 10) + 0.25 * y; }

TEST(BenchSurface, HeightOfAPlaneIsThePlanes) {
  mesh::TriangleMesh mesh = deck::height_field(kX, kY, plane);
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 2)  // whichever side is outside
    std::swap(mesh.triangles[i][0], mesh.triangles[i][1]);
  const BenchSurface surface(mesh);
  EXPECT_THAT(surface.faults(3), IsEmpty());
  std::mt19937 random(1);
  std::uniform_real_distribution<double> x(10, 16), y(-3, 3);
  for (int k = 0; k < 1000; ++k) {
    const double at_x = x(random), at_y = y(random);
    ASSERT_NEAR(surface.height(at_x, at_y), plane(at_x, at_y), 1e-12) << at_x << ' ' << at_y;
  }
  for (const double at_x : kX)
    for (const double at_y : kY) EXPECT_NEAR(surface.height(at_x, at_y), plane(at_x, at_y), 1e-12);
}

TEST(BenchSurface, IsTheGroundInFrontAndItsEdgeBehindAndBeside) {
  const BenchSurface surface(deck::height_field(kX, kY, plane));
  EXPECT_EQ(surface.height(9.99, 0), 0);
  EXPECT_NEAR(surface.height(17, 0.5), plane(16, 0.5), 1e-12);
  EXPECT_NEAR(surface.height(12, 3.2), plane(12, 3), 1e-12);
  EXPECT_NEAR(surface.height(12, -3.2), plane(12, -3), 1e-12);
}

TEST(BenchSurface, HeightOfOneFacetByHand) {
  mesh::TriangleMesh mesh;
  mesh.add_loose({Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(4, 0, 2), Eigen::Vector3d(0, 4, 8)});
  const BenchSurface surface(mesh);
  EXPECT_NEAR(surface.height(1, 1), 0.5 + 2, 1e-12);
  EXPECT_NEAR(surface.height(2, 2), 1 + 4, 1e-12);
  EXPECT_EQ(surface.height(3, 3), 0);  // far from it
}

// Two levels and the upright facets between them: a step at x = 13 and one at y = 0.
TEST(BenchSurface, UprightFacetsAreSteps) {
  mesh::TriangleMesh mesh = deck::height_field({10, 13}, {-2, 2}, [](double, double) { return 1; });
  deck::add(mesh, deck::height_field({13, 16}, {-2, 0}, [](double, double) { return 2; }));
  deck::add(mesh, deck::height_field({13, 16}, {0, 2}, [](double, double) { return 4; }));
  mesh.add_loose(
      {Eigen::Vector3d(13, -2, 1), Eigen::Vector3d(13, 2, 1), Eigen::Vector3d(13, 2, 4)});
  mesh.add_loose({Eigen::Vector3d(13, 0, 2), Eigen::Vector3d(16, 0, 2), Eigen::Vector3d(16, 0, 4)});
  const BenchSurface surface(mesh);
  EXPECT_THAT(surface.faults(2), IsEmpty());
  EXPECT_NEAR(surface.height(12.999, 0), 1, 1e-12);
  EXPECT_NEAR(surface.height(13.001, -0.001), 2, 1e-12);
  EXPECT_NEAR(surface.height(13.001, 0.001), 4, 1e-12);
}

TEST(BenchSurface, SectionsOfATwist) {
  const auto twist = [](double x, double y) { return 3 + y * (x - 13) / 3; };
  std::vector<double> fine;
  for (int i = 0; i <= 60; ++i) fine.push_back(10 + 0.1 * i);
  const BenchSurface surface(deck::height_field(fine, kY, twist));
  const BenchOutline highest = surface.section(2, 1), median = surface.section(2, 0.5);
  EXPECT_NEAR(highest.front().x(), 10, 1e-12);
  EXPECT_NEAR(highest.back().x(), 16, 1e-12);
  for (const double x : {10.0, 11.0, 13.0, 15.5})
    EXPECT_NEAR(outline_height(highest, x), 3 + 2 * std::abs(x - 13) / 3, 1e-9) << x;
  EXPECT_NEAR(outline_height(median, 11), 3, 1e-9);
  EXPECT_NEAR(outline_height(median, 15), 3, 1e-9);
}

TEST(BenchSurface, CutsRocksByTheirOwnPlace) {
  const BenchSurface surface(
      deck::height_field(kX, kY, plane));  // 1.75 at (11, 1), 1.25 at (11, -1)
  const std::vector<deck::PileSphere> spheres = {{1, -1, {11, 1, 1.5}, 0.2},
                                                 {2, -1, {11, -1, 1.5}, 0.2},
                                                 {3, -1, {9.9, 0, 0.1}, 0.1},
                                                 {4, -1, {11, -1, 1.2}, 0.2}};
  EXPECT_EQ(deck::over_surface(spheres, [&](double x, double y) { return surface.height(x, y); }),
            (std::vector<long>{2, 3}));
}

TEST(BenchSurface, ReportsWhatItLeavesBare) {
  const BenchSurface narrow(deck::height_field(kX, kY, plane));
  EXPECT_THAT(
      narrow.faults(3.05),
      ElementsAre(HasSubstr("of the bench uncovered, x = 10 m, y = -3.05 m for one; it lies at "
                            "y = -3 to 3 m and must cover y = -3.05 to 3.05 m")));
  // A hole of one cell; the bench beside it is whole.
  mesh::TriangleMesh mesh;
  const mesh::TriangleMesh whole = deck::height_field(kX, kY, plane);
  for (std::size_t i = 0; i < whole.triangles.size(); ++i)
    if (i / 2 != 7) mesh.add_loose(whole.corners(i));  // x 11.3 to 12, y 1 to 3
  EXPECT_THAT(BenchSurface(mesh).faults(3),
              ElementsAre(HasSubstr("uncovered, x = 11.4 m, y = 1.1")));
  EXPECT_THAT(BenchSurface(mesh).faults(0.9), IsEmpty());
}

TEST(BenchSurface, ReachesOverWhatFallsBetweenTheSteps) {
  mesh::TriangleMesh mesh = deck::height_field({10, 13.02}, kY, plane);
  deck::add(mesh, deck::height_field({13.08, 16}, kY, plane));
  const BenchSurface surface(mesh);
  EXPECT_NEAR(surface.height(13.05, 0.5), plane(13.05, 0.5), 0.03);
  EXPECT_THAT(surface.faults(3), IsEmpty());
}

TEST(BenchSurface, ReportsOverhangs) {
  mesh::TriangleMesh mesh = deck::height_field(kX, kY, plane);
  deck::add(mesh, deck::height_field({12, 12.04}, {0.3, 0.34}, [](double, double) { return 4; }));
  EXPECT_THAT(BenchSurface(mesh).faults(3),
              ElementsAre(testing::AllOf(HasSubstr("overhangs: facets are at z = 2.08"),
                                         HasSubstr("and 4 m at x = 12.0"))));
  EXPECT_THAT(BenchSurface(mesh).faults(0.2), IsEmpty());  // beside the bench
  // The same facets twice are one surface.
  mesh::TriangleMesh twice = deck::height_field(kX, kY, plane);
  deck::add(twice, deck::height_field(kX, kY, plane));
  EXPECT_THAT(BenchSurface(twice).faults(3), IsEmpty());
}

TEST(BenchSurface, ReportsWhatIsUnderTheGround) {
  const auto sunk = [](double by) {
    return BenchSurface(deck::height_field(kX, kY, [by](double x, double) { return x - 10 - by; }));
  };
  EXPECT_THAT(sunk(0.2).faults(3), IsEmpty());  // a scanned floor is rough
  EXPECT_EQ(sunk(0.2).height(10.1, 0), 0);
  EXPECT_THAT(sunk(0.5).faults(3),
              ElementsAre(HasSubstr("is 0.5 m under the ground at x = 10 m, y = -3 m")));
}

}  // namespace
}  // namespace dipper::cases
