// Rock that stands in a wall at the start is taken out, whole and for good; no other rock is.
#include "dem/clear_start.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "common/mesh/signed_distance.hpp"
#include "dem/liggghts_rock.hpp"
#include "tests/dem/momentum.hpp"
#include "tests/dem/scene.hpp"

namespace dipper::dem {
namespace {

/// A trough of steel, open above: a floor and four sides 0.1 m thick about a hollow of 0.8 m. They
/// do not touch: LIGGGHTS wants an edge to have two facets.
mesh::TriangleMesh trough() {
  mesh::TriangleMesh all;
  const auto add = [&](const Vector3d& low, const Vector3d& high) {
    const mesh::TriangleMesh part = test::box(low, high);
    for (std::size_t i = 0; i < part.triangles.size(); ++i) all.add_loose(part.corners(i));
  };
  add({-0.5, -0.5, -0.1}, {0.5, 0.5, 0});
  add({-0.5, -0.5, 0.01}, {-0.4, 0.5, 0.8});
  add({0.4, -0.5, 0.01}, {0.5, 0.5, 0.8});
  add({-0.39, -0.5, 0.01}, {0.39, -0.4, 0.8});
  add({-0.39, 0.4, 0.01}, {0.39, 0.5, 0.8});
  return all;
}

struct Sphere {
  int rock;  ///< of a body its tag, of a single sphere less than -its id
  Vector3d p_W;
  double radius_m;
};

/// Of all ranks, by id.
std::map<int, Sphere> spheres(LAMMPS_NS::LAMMPS& lmp) {
  auto* bodies =
      static_cast<LAMMPS_NS::FixMultisphere*>(lmp.modify->find_fix_style("multisphere", 0));
  const LAMMPS_NS::Atom& atom = *lmp.atom;
  const auto n = static_cast<std::size_t>(lmp.atom->tag_max()) + 1;
  std::vector<double> rows(6 * n, 0);
  for (int i = 0; i < atom.nlocal; ++i) {
    double* row = &rows[6 * static_cast<std::size_t>(atom.tag[i])];
    const int body = bodies == nullptr ? -1 : bodies->belongs_to(i);
    row[0] = 1;
    row[1] = body >= 0 ? body : -1 - atom.tag[i];
    std::copy_n(atom.x[i], 3, row + 2);
    row[5] = atom.radius[i];
  }
  MPI_Allreduce(MPI_IN_PLACE, rows.data(), static_cast<int>(rows.size()), MPI_DOUBLE, MPI_SUM,
                MPI_COMM_WORLD);
  std::map<int, Sphere> out;
  for (std::size_t k = 0; k < n; ++k) {
    const double* row = &rows[6 * k];
    if (row[0] > 0)
      out[static_cast<int>(k)] = {static_cast<int>(row[1]), {row[2], row[3], row[4]}, row[5]};
  }
  return out;
}

class ClearStart : public testing::TestWithParam<const char*> {};

TEST_P(ClearStart, TakesOutTheRockInTheWallsAndNoOther) {
  const std::string kind = GetParam();
  const test::Scene scene("clear_" + kind);
  const auto restart = scene.folder() / "bed.restart";
  std::map<int, Sphere> before;
  test::Momentum all;
  {
    LiggghtsRock rock(scene.bed(kind), MPI_COMM_WORLD);
    const Pose far{Quaterniond::Identity(), {0, 0, 7}};
    rock.place({far});
    for (int k = 0; k < 30; ++k) rock.step({100, {far}});  // 0.3 s: rock lies upon rock
    rock.save(restart);
    before = spheres(rock.liggghts());
    all = test::momentum(rock.liggghts());
  }
  setup::RockSetup setup = scene.setup("clear.in");
  setup.bodies = setup.cleared = {"block"};
  setup.variables.push_back({"clumps", kind == "multispheres" ? "1" : "0"});
  setup.variables.push_back({"restart", restart.string()});
  setup.variables.push_back({"block", scene.stl("block", trough())});
  const Pose X_WB{from_rotation_vector({0.2, 0.1, 0.5}), {0.1, 0, 0.15}};
  LiggghtsRock rock(setup, MPI_COMM_WORLD);
  core::RockState s = rock.place({X_WB});

  // By hand, from what was there.
  mesh::TriangleMesh placed = trough();
  for (auto& v : placed.vertices) v = X_WB * v;
  std::set<int> rocks_in;
  for (const auto& [id, b] : before)
    if (mesh::signed_distance(placed, b.p_W) > -b.radius_m) rocks_in.insert(b.rock);
  std::set<int> expected, in_hollow;
  for (const auto& [id, b] : before) {
    if (rocks_in.count(b.rock) != 0) continue;
    expected.insert(id);
    const Vector3d p_B = inverse(X_WB) * b.p_W;
    if (p_B.cwiseAbs().head<2>().maxCoeff() < 0.4 && p_B.z() > 0 && p_B.z() < 0.8)
      in_hollow.insert(b.rock);
  }
  std::set<int> left;
  for (const auto& [id, b] : spheres(rock.liggghts())) left.insert(id);
  EXPECT_EQ(left, expected);
  ASSERT_GT(rocks_in.size(), 5U);
  EXPECT_GT(in_hollow.size(), 0U) << "rock free in the hollow stays";

  const test::Momentum after = test::momentum(rock.liggghts());
  const auto channel = [&](const char* name) {
    return s.channels[core::channel_index(rock.info(), name)];
  };
  EXPECT_EQ(channel("rocks_removed"), rocks_in.size());
  EXPECT_NEAR(channel("mass_removed"), all.mass - after.mass, 1e-9 * all.mass);
  EXPECT_NEAR(channel("rock_mass"), after.mass, 1e-9 * all.mass);
  EXPECT_EQ(channel("particles"), left.size());
  EXPECT_EQ(s.bodies[0].end.force.norm(), 0) << "nothing touches the wall";
  if (test::rank() == 0)
    fmt::print("{}: {} rocks, {:.1f} of {:.1f} kg out; {} free in the hollow\n", kind,
               rocks_in.size(), channel("mass_removed"), all.mass, in_hollow.size());

  // And it goes on: nothing is shot out, nothing comes back, and a checkpoint can be written.
  double fastest = 0;
  for (int k = 0; k < 30; ++k) {
    s = rock.step({100, {X_WB}});
    fastest = std::max(fastest, std::sqrt(2 * channel("rock_kinetic_energy") / after.mass));
  }
  EXPECT_LT(fastest, 3);  // 0.3 s of free fall
  EXPECT_EQ(channel("particles"), left.size());
  EXPECT_EQ(test::momentum(rock.liggghts()).bodies, after.bodies);
  rock.save(scene.folder() / "after.restart");
  EXPECT_EQ(channel("rocks_removed"), rocks_in.size());
}

INSTANTIATE_TEST_SUITE_P(Rock, ClearStart, testing::Values("spheres", "multispheres"),
                         [](const auto& kind) { return std::string(kind.param); });

TEST(ClearStartSetup, IsAskedForByName) {
  setup::RockSetup setup;
  setup.cleared = {"dipper", "truck"};
  EXPECT_EQ(setup::rock_setup_from(to_json(setup)).cleared, setup.cleared);
  auto old = to_json(setup);  // a recording of before
  old.erase("cleared");
  EXPECT_TRUE(setup::rock_setup_from(old).cleared.empty());
}

}  // namespace
}  // namespace dipper::dem
