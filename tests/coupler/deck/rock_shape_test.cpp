// Rock shapes: the library's against published ratios, and a user's STL by its name.
#include "coupler/deck/rock_shape.hpp"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <Eigen/Geometry>
#include <stdexcept>

#include "common/cache_folder.hpp"
#include "common/mesh/stl.hpp"
#include "coupler/deck/shape_library.hpp"
#include "tests/common/mesh/shapes.hpp"
#include "tests/coupler/deck/liggghts_run.hpp"
#include "tests/places.hpp"

namespace dipper::deck {
namespace {

namespace fs = std::filesystem;
const fs::path kRocks = test::source() / "meshes/rocks";

void write_text(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }

std::string error_of(const fs::path& folder, const std::string& name) {
  try {
    find_rock_shape(folder, name);
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "";
}

/// A cache of the test's own.
class Library : public testing::Test {
 protected:
  void SetUp() override {
    folder = fresh_folder("shapes");
    set_cache_folder(folder / "cache");
  }
  std::size_t cached() const {
    std::size_t n = 0;
    std::error_code none;
    for ([[maybe_unused]] const auto& entry : fs::directory_iterator(folder / "cache/shapes", none))
      ++n;
    return n;
  }
  fs::path folder;
};

TEST(RockShape, ACubeByItsKnownRatios) {
  const RockShape s = make_rock_shape("cube", test::box({5, 5, 5}, {7, 7, 7}));
  EXPECT_NEAR(s.mass.volume_m3, M_PI / 6, 1e-12);
  EXPECT_LT(s.mass.com_m.norm(), 1e-12);
  EXPECT_NEAR(s.sphericity, std::cbrt(M_PI / 6), 1e-9);  // 0.806
  EXPECT_NEAR(s.aspect_ratio, 1, 0.5);                   // any axes are principal
  for (const ShapeResolution& r : kShapeResolutions)
    EXPECT_EQ(s.fit(r.name).spheres.size(), static_cast<std::size_t>(r.spheres));
  EXPECT_THROW(s.fit("finest"), std::invalid_argument);
}

TEST(RockShape, ABrickTurnedInSpaceByItsSides) {
  mesh::TriangleMesh brick = test::box({0, 0, 0}, {3, 2, 1});
  const Eigen::Matrix3d R =
      (Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized())).toRotationMatrix();
  for (auto& v : brick.vertices) v = R * v;
  const RockShape s = make_rock_shape("brick", brick);
  EXPECT_NEAR(s.aspect_ratio, 1.5, 1e-9);
  EXPECT_NEAR(s.flatness, 0.5, 1e-9);
}

TEST(RockFiles, MatchTheirMeshes) {
  for (const std::string& name : shape_names(kRocks)) {
    EXPECT_FALSE(is_made_from_mesh(kRocks, name)) << name << ": run scripts/make_meshes";
    const RockShape s = read_rock_shape(kRocks / (name + ".yaml"));
    const mesh::TriangleMesh mesh = mesh::read_stl(kRocks / (name + ".stl"));
    const mesh::MassProperties m = mesh::mass_properties(mesh);
    EXPECT_NEAR(m.volume_m3, M_PI / 6, 1e-6) << name;
    EXPECT_LT(m.com_m.norm(), 1e-6) << name;
    EXPECT_TRUE(s.mass.inertia_m5.isApprox(m.inertia_m5, 1e-6)) << name;
    const std::map<std::string, double> most = {{"coarse", 0.26}, {"medium", 0.18}, {"fine", 0.13}};
    for (const auto& [resolution, fit] : s.fits) {
      EXPECT_NEAR(union_volume(fit.spheres, 400) / m.volume_m3, 1, 2e-3) << name;
      EXPECT_NEAR(symmetric_difference(mesh, fit.spheres), fit.symmetric_difference, 1e-3) << name;
      EXPECT_LT(fit.symmetric_difference, most.at(resolution)) << name;
    }
  }
}

TEST(RockFiles, HaveTheShapeOfBlastedRock) {
  const YAML::Node known = YAML::LoadFile((kRocks.parent_path() / "blasted_rock.yaml").string());
  const auto mean = known["axis_ratio_mean"], axes = known["axis_ratio_range"],
             sphericity = known["sphericity_range"];
  double elongation = 0, flatness = 0;
  const std::set<std::string> names = shape_names(kRocks);
  ASSERT_GE(names.size(), 7U);
  for (const std::string& name : names) {
    const RockShape s = read_rock_shape(kRocks / (name + ".yaml"));
    EXPECT_GT(1 / s.aspect_ratio, axes["least_I_L"].as<double>()) << name;
    EXPECT_GT(s.flatness / s.aspect_ratio, axes["least_S_L"].as<double>() - 1e-3) << name;
    EXPECT_GT(s.sphericity, sphericity["least"].as<double>()) << name;
    EXPECT_LT(s.sphericity, sphericity["most"].as<double>()) << name;
    elongation += 1 / s.aspect_ratio / static_cast<double>(names.size());
    flatness += s.flatness / static_cast<double>(names.size());
  }
  EXPECT_NEAR(elongation, mean["elongation_I_L"].as<double>(), 0.05);
  EXPECT_NEAR(flatness, mean["flatness_S_I"].as<double>(), 0.05);
}

TEST_F(Library, AnStlByItsNameIsFittedOnceAndKept) {
  write_text(folder / "scan.stl", mesh::to_stl("scan", test::box({0, 0, 0}, {30, 20, 10})));
  const RockShape first = find_rock_shape(folder, "scan");
  EXPECT_NEAR(first.aspect_ratio, 1.5, 1e-6);
  EXPECT_EQ(cached(), 1U);
  EXPECT_EQ(to_yaml(find_rock_shape(folder, "scan")), to_yaml(first));
  EXPECT_EQ(cached(), 1U);
}

TEST_F(Library, AnotherMeshIsNotTakenForTheOneOfTheYaml) {
  fs::copy(kRocks / "block.yaml", folder / "block.yaml");
  EXPECT_FALSE(is_made_from_mesh(folder, "block"));  // the mesh is not asked for
  fs::copy(kRocks / "block.stl", folder / "block.stl");
  EXPECT_FALSE(is_made_from_mesh(folder, "block"));
  write_text(folder / "block.stl", mesh::to_stl("block", test::box({0, 0, 0}, {4, 2, 1})));
  EXPECT_TRUE(is_made_from_mesh(folder, "block"));
  EXPECT_NEAR(find_rock_shape(folder, "block").aspect_ratio, 2, 1e-6);
}

TEST_F(Library, AMeshThatIsNoRockIsRefusedWithItsFileAndFault) {
  const mesh::TriangleMesh sound = test::box({0, 0, 0}, {1, 1, 1});
  mesh::TriangleMesh open = sound, inverted = sound, flipped = sound, two = sound;
  open.triangles.pop_back();
  for (auto& t : inverted.triangles) std::swap(t[1], t[2]);
  std::swap(flipped.triangles[3][1], flipped.triangles[3][2]);
  for (const auto& v : sound.vertices) two.vertices.push_back(v + Eigen::Vector3d(5, 0, 0));
  for (const auto& t : sound.triangles) two.triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
  const std::vector<std::tuple<std::string, mesh::TriangleMesh, std::string>> bad = {
      {"open", open, "not closed"},
      {"inverted", inverted, "faces inwards"},
      {"flipped", flipped, "is flipped"},
      {"two", two, "2 separate shells"}};
  for (const auto& [name, mesh, fault] : bad) {
    const fs::path file = folder / (name + ".stl");
    write_text(file, mesh::to_stl(name, mesh));
    const std::string error = error_of(folder, name);
    EXPECT_NE(error.find(file.string()), std::string::npos) << error;
    EXPECT_NE(error.find(fault), std::string::npos) << error;
  }
  write_text(folder / "text.stl", "this is no mesh");
  EXPECT_NE(error_of(folder, "text").find("text.stl"), std::string::npos);
  EXPECT_EQ(cached(), 0U);
}

TEST_F(Library, AYamlOfAnOlderFormatSaysWhatToDo) {
  write_text(folder / "old.yaml", "name: old\nmesh_sha256: 0\nvolume: 1\n");
  EXPECT_NE(error_of(folder, "old").find("area: missing key"), std::string::npos);
}

}  // namespace
}  // namespace dipper::deck
