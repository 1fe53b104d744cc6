// While LIGGGHTS runs, no contact is missing from its lists: what touches is found by brute force
// over all places and looked for in the lists, with rock held, parked and woken, and with a wall
// that moves.
#include <atom.h>
#include <fix_mesh_surface.h>
#include <fix_multisphere.h>
#include <fix_neighlist_mesh.h>
#include <fmt/format.h>
#include <force.h>
#include <gtest/gtest.h>
#include <modify.h>
#include <neigh_list.h>
#include <pair.h>
#include <tri_mesh.h>

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include "dem/all_ranks.hpp"
#include "dem/liggghts_rock.hpp"
#include "dem/parked_rock.hpp"
#include "tests/dem/scene.hpp"

namespace dipper::dem {
namespace {

constexpr int kSteps = 20, kWindows = 240;

/// A sphere, wherever it is.
struct Ball {
  double id, body, rank;  ///< body -1: none
  double x, y, z, r;
};

std::vector<Ball> all_balls(LAMMPS_NS::LAMMPS& lmp) {
  LAMMPS_NS::FixMultisphere* bodies = multisphere_of(lmp);
  std::vector<Ball> mine;
  const LAMMPS_NS::Atom* atom = lmp.atom;
  for (int i = 0; i < atom->nlocal; ++i)
    mine.push_back({static_cast<double>(atom->tag[i]),
                    static_cast<double>(bodies == nullptr ? -1 : bodies->belongs_to(i)),
                    static_cast<double>(test::rank()), atom->x[i][0], atom->x[i][1], atom->x[i][2],
                    atom->radius[i]});
  return of_all_ranks(mine, MPI_COMM_WORLD);
}

using Pair = std::pair<int, int>;  // of ids, the lower first

/// Of this rank's list, all pairs.
std::set<Pair> listed(LAMMPS_NS::LAMMPS& lmp) {
  const LAMMPS_NS::NeighList* list = lmp.force->pair->list;
  const int* tag = lmp.atom->tag;
  std::set<Pair> pairs;
  for (int k = 0; k < list->inum; ++k) {
    const int i = list->ilist[k];
    for (int n = 0; n < list->numneigh[i]; ++n)
      pairs.insert(std::minmax(tag[i], tag[list->firstneigh[i][n] & NEIGHMASK]));
  }
  return pairs;
}

struct Tally {
  long touching = 0, missing = 0;
};

/// Pairs that touch, of which one at least is this rank's.
Tally spheres_tally(LAMMPS_NS::LAMMPS& lmp) {
  const std::vector<Ball> balls = all_balls(lmp);
  const std::set<Pair> pairs = listed(lmp);
  Tally t;
  for (std::size_t a = 0; a < balls.size(); ++a) {
    for (std::size_t b = a + 1; b < balls.size(); ++b) {
      const Ball &p = balls[a], &q = balls[b];
      if (p.rank != test::rank() && q.rank != test::rank()) continue;
      if (p.body >= 0 && p.body == q.body) continue;
      if (Vector3d(p.x - q.x, p.y - q.y, p.z - q.z).norm() >= p.r + q.r) continue;
      ++t.touching;
      t.missing += pairs.count(std::minmax(static_cast<int>(p.id), static_cast<int>(q.id))) == 0;
    }
  }
  return t;
}

/// This rank's spheres that touch a triangle of the wall, ghosts of triangles included.
Tally wall_tally(LAMMPS_NS::LAMMPS& lmp, const char* name) {
  auto* wall = dynamic_cast<LAMMPS_NS::FixMeshSurface*>(lmp.modify->find_fix_id(name));
  LAMMPS_NS::TriMesh* mesh = wall->triMesh();
  Tally t;
  for (int i = 0; i < lmp.atom->nlocal; ++i) {
    for (int tri = 0; tri < mesh->sizeLocal() + mesh->sizeGhost(); ++tri) {
      double delta[3], bary[3];
      int side = -1;
      if (mesh->resolveTriSphereContactBary(i, tri, lmp.atom->radius[i], lmp.atom->x[i], delta,
                                            bary, side, true) > 0)
        continue;
      ++t.touching;
      t.missing += !wall->meshNeighlist()->contactInList(tri, i);
    }
  }
  return t;
}

/// Pairs of this rank's list that do not touch and still have contact history: a tangential spring
/// or a rolling torque.
long parted_with_history(LAMMPS_NS::LAMMPS& lmp) {
  const LAMMPS_NS::NeighList* list = lmp.force->pair->list;
  const LAMMPS_NS::NeighList* history = list->listgranhistory;
  const LAMMPS_NS::Atom* atom = lmp.atom;
  long count = 0;
  for (int k = 0; k < list->inum; ++k) {
    const int i = list->ilist[k];
    for (int n = 0; n < list->numneigh[i]; ++n) {
      const int j = list->firstneigh[i][n] & NEIGHMASK;
      const Vector3d apart(atom->x[i][0] - atom->x[j][0], atom->x[i][1] - atom->x[j][1],
                           atom->x[i][2] - atom->x[j][2]);
      if (apart.norm() < atom->radius[i] + atom->radius[j]) continue;
      const double* h = history->firstdouble[i] + n * history->dnum;
      count += std::any_of(h, h + history->dnum, [](double v) { return v != 0; });
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, &count, 1, MPI_LONG, MPI_SUM, MPI_COMM_WORLD);
  return count;
}

/// The bed and its paddle, which goes down into it at 2 m/s.
class Bed {
 public:
  Bed(const std::string& kind, bool held, const std::string& stiff)
      : scene_("lists"), rock_(setup(kind, held, stiff), MPI_COMM_WORLD) {
    rock_.place({paddle(0)});
  }
  LAMMPS_NS::LAMMPS& step() {
    rock_.step({kSteps, {paddle(++windows_)}});
    return rock_.liggghts();
  }

 private:
  static Pose paddle(int k) {
    return {Quaterniond::Identity(), Vector3d(0.05, 0, 1.6 - 2.0 * k * kSteps * 1e-4)};
  }
  setup::RockSetup setup(const std::string& kind, bool held, const std::string& stiff) const;

  test::Scene scene_;
  LiggghtsRock rock_;
  int windows_ = 0;
};

setup::RockSetup Bed::setup(const std::string& kind, bool held, const std::string& stiff) const {
  setup::RockSetup s = scene_.bed(kind);
  s.variables.push_back({"stiff", stiff});
  if (held) s.hold = test::lively_hold();
  return s;
}

class ContactLists : public testing::TestWithParam<std::tuple<const char*, bool>> {};

TEST_P(ContactLists, HoldAllThatTouches) {
  const auto [kind, held] = GetParam();
  Bed bed(kind, held, "1e6");
  Tally spheres, walls;
  for (int k = 1; k <= kWindows; ++k) {
    LAMMPS_NS::LAMMPS& lmp = bed.step();
    for (const auto& [sum, now] :
         {std::pair{&spheres, spheres_tally(lmp)}, std::pair{&walls, wall_tally(lmp, "paddle")},
          std::pair{&walls, wall_tally(lmp, "floor")}}) {
      sum->touching += now.touching;
      sum->missing += now.missing;
    }
  }
  fmt::print("{}{}, rank {}: {} touches of spheres and {} of walls seen, {} and {} not in lists\n",
             kind, held ? " held" : "", test::rank(), spheres.touching, walls.touching,
             spheres.missing, walls.missing);
  EXPECT_GT(spheres.touching, 1000);
  EXPECT_GT(walls.touching, 100);
  EXPECT_EQ(spheres.missing, 0);
  EXPECT_EQ(walls.missing, 0);
}

// LIGGGHTS itself forgets what a pair that has parted had only as it builds lists: a run that goes
// on from a checkpoint builds them at other steps, and would depart from the uninterrupted one.
TEST_P(ContactLists, KeepNoHistoryOfPairsThatHaveParted) {
  const auto [kind, held] = GetParam();
  Bed bed(kind, held, "2e7");  // a contact lasts some ten steps and ends with a force
  long kept = 0;
  for (int k = 1; k <= kWindows; ++k) kept += parted_with_history(bed.step());
  EXPECT_EQ(kept, 0);
}

INSTANTIATE_TEST_SUITE_P(Rock, ContactLists,
                         testing::Combine(testing::Values("spheres", "multispheres"),
                                          testing::Bool()),
                         [](const auto& p) {
                           return std::string(std::get<0>(p.param)) +
                                  (std::get<1>(p.param) ? "_held" : "");
                         });

}  // namespace
}  // namespace dipper::dem
