#include "coupler/deck/triangle_mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>

#include "tests/deck/shapes.hpp"

namespace dipper {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

TEST(MassProperties, UnitCubeIsExact) {
  const TriangleMesh cube = box_mesh({0, 0, 0}, {1, 1, 1});
  const MassProperties m = mass_properties(cube);
  EXPECT_TRUE(is_closed(cube));
  EXPECT_NEAR(m.volume_m3, 1, 1e-15);
  EXPECT_NEAR(m.area_m2, 6, 1e-14);
  EXPECT_TRUE(m.com_m.isApprox(Vector3d::Constant(0.5), 1e-14));
  EXPECT_TRUE(m.inertia_m5.isApprox(Matrix3d::Identity() / 6, 1e-13));
}

TEST(MassProperties, BoxFarFromTheOrigin) {
  const MassProperties m = mass_properties(box_mesh({10, -7, 3}, {12, -4, 8}));
  const double a = 2, b = 3, c = 5, v = a * b * c;
  EXPECT_NEAR(m.volume_m3, v, 1e-12);
  EXPECT_TRUE(m.com_m.isApprox(Vector3d(11, -5.5, 5.5), 1e-13));
  const Matrix3d want =
      v / 12 * Vector3d(b * b + c * c, a * a + c * c, a * a + b * b).asDiagonal().toDenseMatrix();
  EXPECT_TRUE(m.inertia_m5.isApprox(want, 1e-10));
}

TEST(MassProperties, CornerTetrahedron) {
  // x, y, z >= 0, x + y + z <= 1: V = 1/6, centroid 1/4, about it Ixx = 1/80, Ixy = +1/480.
  const Vector3d o(0, 0, 0), x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  const TriangleMesh t = {{o, y, x}, {o, z, y}, {o, x, z}, {x, y, z}};
  const MassProperties m = mass_properties(t);
  EXPECT_TRUE(is_closed(t));
  EXPECT_NEAR(m.volume_m3, 1.0 / 6, 1e-15);
  EXPECT_TRUE(m.com_m.isApprox(Vector3d::Constant(0.25), 1e-14));
  EXPECT_NEAR(m.inertia_m5(0, 0), 1.0 / 80, 1e-15);
  EXPECT_NEAR(m.inertia_m5(0, 1), 1.0 / 480, 1e-15);
}

TEST(MassProperties, SphereConvergesWithTheSquareOfTheFacet) {
  const auto error = [](int n) {
    return 1 - mass_properties(sphere_mesh(1.0, n)).volume_m3 / (4 * M_PI / 3);
  };
  EXPECT_NEAR(error(20) / error(40), 4, 0.1);
  const MassProperties m = mass_properties(sphere_mesh(2.0, 60));
  EXPECT_NEAR(m.inertia_m5(0, 0) / (0.4 * m.volume_m3 * 4), 1, 0.005);
}

TEST(IsClosed, SeesAHoleAndATurnedFacet) {
  TriangleMesh cube = box_mesh({0, 0, 0}, {1, 1, 1});
  std::swap(cube[3][0], cube[3][1]);
  EXPECT_FALSE(is_closed(cube));
  cube.pop_back();
  EXPECT_FALSE(is_closed(cube));
}

TEST(SignedDistance, InsideIsPositive) {
  const TriangleMesh cube = box_mesh({0, 0, 0}, {1, 1, 1});
  EXPECT_NEAR(signed_distance(cube, {0.5, 0.5, 0.7}), 0.3, 1e-14);
  EXPECT_NEAR(signed_distance(cube, {0.5, 0.5, 1.7}), -0.7, 1e-14);
  EXPECT_NEAR(signed_distance(cube, {2, 2, 2}), -std::sqrt(3.0), 1e-14);
}

TEST(ReadStl, BinaryAndAsciiAreTheSame) {
  const auto folder = std::filesystem::path(testing::TempDir());
  const TriangleMesh cube = box_mesh({0, 0, 0}, {1, 2, 3});
  std::ofstream ascii(folder / "ascii.stl");
  std::ofstream binary(folder / "binary.stl", std::ios::binary);
  binary << "solid, and still binary" << std::string(80 - 23, ' ');
  const auto count = static_cast<std::uint32_t>(cube.size());
  binary.write(reinterpret_cast<const char*>(&count), 4);
  ascii << "solid cube\n";
  for (const Triangle& t : cube) {
    ascii << "facet normal 0 0 0\nouter loop\n";
    float f[12] = {};
    for (int k = 0; k < 3; ++k) {
      ascii << "vertex " << t[k].transpose() << "\n";
      for (int i = 0; i < 3; ++i) f[3 + 3 * k + i] = static_cast<float>(t[k][i]);
    }
    ascii << "endloop\nendfacet\n";
    binary.write(reinterpret_cast<const char*>(f), sizeof(f));
    binary.write("\0\0", 2);
  }
  ascii.close();
  binary.close();
  for (const char* name : {"ascii.stl", "binary.stl"}) {
    const TriangleMesh read = read_stl(folder / name);
    ASSERT_EQ(read.size(), cube.size()) << name;
    EXPECT_NEAR(mass_properties(read).volume_m3, 6, 1e-12) << name;
  }
}

TEST(ReadStl, NamesTheFileThatIsNone) {
  const auto file = std::filesystem::path(testing::TempDir()) / "none.stl";
  std::ofstream(file) << "not a mesh";
  try {
    read_stl(file);
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string(e.what()).find("none.stl"), std::string::npos);
  }
}

}  // namespace
}  // namespace dipper
