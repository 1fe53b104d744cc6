// A user's scans, dropped into a folder as STL files, settle under the plain binary.
#include <gtest/gtest.h>

#include <map>
#include <sstream>

#include "common/cache_folder.hpp"
#include "common/mesh/stl.hpp"
#include "coupler/deck/contact_table.hpp"
#include "coupler/deck/deck.hpp"
#include "coupler/deck/rock_shape.hpp"
#include "tests/common/mesh/shapes.hpp"
#include "tests/coupler/deck/liggghts_run.hpp"
#include "tests/coupler/deck/quick_case.hpp"

namespace dipper::deck {
namespace {

namespace fs = std::filesystem;

/// A scan as it comes: in millimetres, anywhere, bumpy, of a few thousand facets.
mesh::TriangleMesh scan() {
  mesh::TriangleMesh mesh = test::sphere(1, 40);
  for (auto& v : mesh.vertices) {
    const double bumps = 1 + 0.1 * std::sin(7 * v.x() + 2 * v.y()) * std::cos(5 * v.z());
    v = 300 * bumps * v.cwiseProduct(Eigen::Vector3d(1.4, 1.0, 0.8)) +
        Eigen::Vector3d(4000, -2000, 900);
  }
  return mesh;
}

TEST(UserRock, SettlesByItsName) {
  const fs::path folder = fresh_folder("user_rock"), shapes = folder / "scans";
  set_cache_folder(folder / "cache");
  fs::create_directories(shapes);
  std::ofstream(shapes / "boulder.stl") << mesh::to_stl("boulder", scan());
  std::ofstream(shapes / "brick.stl") << mesh::to_stl("brick", test::box({0, 0, 0}, {3, 2, 1.5}));
  cases::Case c = tiny_case();
  c.rock.coarse_graining = 1;
  c.rock.shape_resolution = "medium";
  c.dem.timestep_s = 2e-4;
  c.rock.classes = {{"fine", 0.30, 50, {"sphere"}}, {"scanned", 0.35, 50, {"boulder", "brick"}}};
  c.pile.height_m = 2;
  c.pile.width_m = 3;
  c.pile.settle_s = 1;
  c.pile.relax_s = 0.3;
  write_deck(c, shapes, folder / "deck");
  ASSERT_EQ(
      run_liggghts("dem_in/settle.in", "-var deck '" + (folder / "deck").string() + "'", 1, folder),
      0)
      << read_text(folder / "screen.txt");
  const std::string dig = "-var deck '" + (folder / "deck").string() + "' -var pile '" +
                          (folder / "pile.restart").string() +
                          "' -var run_steps 1 -var dump_steps 1";
  ASSERT_EQ(run_liggghts("dem_in/dig.in", dig, 1, folder), 0) << read_text(folder / "screen.txt");

  std::ifstream in(folder / "rocks_1.dump");
  std::map<int, int> spheres;  // of each rock
  std::string line;
  while (std::getline(in, line) && line.rfind("ITEM: ATOMS id type id_multisphere x y z", 0) != 0) {
  }
  while (std::getline(in, line)) {
    std::istringstream words(line);
    int id = 0, type = 0, rock = 0;
    double x = 0, y = 0, z = 0;
    words >> id >> type >> rock >> x >> y >> z;
    EXPECT_GT(z, 0);
    EXPECT_LT(z, c.pile.height_m + 0.2);
    EXPECT_EQ(type == 1, rock == -1);
    if (rock >= 0) ++spheres[rock];
  }
  EXPECT_GT(spheres.size(), 10U);
  for (const auto& [rock, n] : spheres) EXPECT_EQ(n, 12) << rock;
}

}  // namespace
}  // namespace dipper::deck
