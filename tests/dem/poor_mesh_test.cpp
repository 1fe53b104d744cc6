// What LIGGGHTS has to say of a poor mesh it says on the rank that has the triangle, and goes on.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <iterator>

#include "dem/liggghts_rock.hpp"
#include "tests/dem/scene.hpp"

namespace dipper::dem {
namespace {

/// Two triangles on one edge that cover each other, about y = `y_m`.
void add_fold(mesh::TriangleMesh& mesh, double y_m) {
  const auto at = [&](double x, double z) { return Vector3d(x, y_m, z); };
  mesh.add_loose({at(-1, 4), at(1, 4), at(-0.5, 6)});
  mesh.add_loose({at(-1, 4), at(1, 4), at(0.5, 6)});
}

TEST(PoorMesh, IsReportedOnEveryRankThatHasSomeOfIt) {
  const test::Scene scene("poor_mesh");
  setup::RockSetup setup = scene.setup("pose.in");
  mesh::TriangleMesh folded;
  for (const double y_m : {-2.0, 2.0}) add_fold(folded, y_m);  // a rank each, of two
  setup.variables.push_back({"dipper", scene.stl("dipper", folded)});
  setup.variables.push_back(
      {"door", scene.stl("door", test::box(Vector3d(-1, -1, 4), Vector3d(1, 1, 6)))});
  setup.bodies = {"dipper", "door"};

  testing::internal::CaptureStdout();
  LiggghtsRock rock(setup, MPI_COMM_WORLD);
  const core::RockState placed = rock.place({Pose{}, Pose{}});
  std::fflush(nullptr);
  const std::string said = testing::internal::GetCapturedStdout();
  std::ifstream screen(setup.screen);
  const std::string shown{std::istreambuf_iterator<char>(screen), {}};
  const std::string warning = fmt::format("Mesh dipper: proc {} has", test::rank());
  EXPECT_THAT(test::rank() == 0 ? shown : said, testing::HasSubstr(warning));
  EXPECT_EQ(placed.bodies.size(), 2U);
}

}  // namespace
}  // namespace dipper::dem
