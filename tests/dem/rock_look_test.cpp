// The rock seen from above is all of it: on every rank, parked or not, and looking changes nothing.
#include "dem/rock_look.hpp"

#include <atom.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "dem/liggghts_rock.hpp"
#include "tests/dem/scene.hpp"

namespace dipper::dem {
namespace {

constexpr HeightGrid kGrid{-0.9, -0.9, 0.06, 30, 30};

/// x, y, z and radius of every sphere that LIGGGHTS has, of all ranks.
std::vector<double> spheres(LAMMPS_NS::LAMMPS& lmp) {
  std::vector<double> mine;
  const LAMMPS_NS::Atom* atom = lmp.atom;
  for (int i = 0; i < atom->nlocal; ++i) {
    mine.insert(mine.end(), atom->x[i], atom->x[i] + 3);
    mine.push_back(atom->radius[i]);
  }
  int ranks = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  const int n = static_cast<int>(mine.size());
  std::vector<int> counts(static_cast<std::size_t>(ranks)), offsets(counts.size(), 0);
  MPI_Allgather(&n, 1, MPI_INT, counts.data(), 1, MPI_INT, MPI_COMM_WORLD);
  for (std::size_t r = 1; r < counts.size(); ++r) offsets[r] = offsets[r - 1] + counts[r - 1];
  std::vector<double> all(static_cast<std::size_t>(offsets.back() + counts.back()));
  MPI_Allgatherv(mine.data(), n, MPI_DOUBLE, all.data(), counts.data(), offsets.data(), MPI_DOUBLE,
                 MPI_COMM_WORLD);
  return all;
}

class RockLook : public testing::TestWithParam<const char*> {};

TEST_P(RockLook, IsTheTopOfAllRock) {
  const std::string kind = GetParam();
  const bool held = kind == "held";
  const test::Scene scene("look_" + kind);
  setup::RockSetup setup = scene.bed(held ? "spheres" : kind);
  if (held) setup.hold = test::lively_hold();
  LiggghtsRock rock(setup, MPI_COMM_WORLD);
  const Pose far{Quaterniond::Identity(), {0, 0, 7}};
  rock.place({far});
  core::RockState s;
  for (int k = 0; k < 150; ++k) s = rock.step({100, {far}});  // it comes to rest

  const HeightMap seen = rock.look(kGrid);
  if (held) {
    // What is parked is not in LIGGGHTS; the map has it all the same.
    const double parked_kg = s.channels[core::channel_index(rock.info(), "rock_parked")];
    ASSERT_GT(parked_kg, 0);
  }
  const std::vector<double> all = spheres(rock.liggghts());
  int higher = 0, covered = 0;
  for (int i = 0; i < kGrid.nx; ++i)
    for (int j = 0; j < kGrid.ny; ++j) {
      double top = 0;
      for (std::size_t k = 0; k < all.size(); k += 4) {
        const double left = all[k + 3] * all[k + 3] - std::pow(all[k] - seen.x_of(i), 2) -
                            std::pow(all[k + 1] - seen.y_of(j), 2);
        if (left > 0) top = std::max(top, all[k + 2] + std::sqrt(left));
      }
      if (held) {
        ASSERT_GE(seen.at(i, j), top - 1e-9);
        if (seen.at(i, j) > top + 1e-3) ++higher;
      } else {
        ASSERT_NEAR(seen.at(i, j), top, 1e-9);
      }
      if (seen.at(i, j) > 0) ++covered;
    }
  EXPECT_GT(covered, 20);
  EXPECT_EQ(higher > 0, held) << "parked rock is seen";
  const std::string before = rock.state_hash();
  EXPECT_EQ(rock.look(kGrid).heights(), seen.heights());
  EXPECT_EQ(rock.state_hash(), before);
}

INSTANTIATE_TEST_SUITE_P(Rock, RockLook, testing::Values("spheres", "multispheres", "held"),
                         [](const auto& kind) { return std::string(kind.param); });

}  // namespace
}  // namespace dipper::dem
