// Rock that is held keeps its stress: a settled bed is held for 1 s and woken, and nothing happens.
#include <fix.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "dem/liggghts_rock.hpp"
#include "tests/dem/momentum.hpp"
#include "tests/dem/scene.hpp"
#include "tests/dem/spheres.hpp"

namespace dipper::dem {
namespace {

constexpr int kSteps = 100;  // a window: 0.01 s

/// The groups of every sphere, by id: who is integrated.
std::vector<int> groups(LAMMPS_NS::LAMMPS& lmp) {
  std::vector<int> mask(static_cast<std::size_t>(lmp.atom->tag_max()) + 1, 0);
  for (int i = 0; i < lmp.atom->nlocal; ++i)
    mask[static_cast<std::size_t>(lmp.atom->tag[i])] = lmp.atom->mask[i];
  MPI_Allreduce(MPI_IN_PLACE, mask.data(), static_cast<int>(mask.size()), MPI_INT, MPI_MAX,
                MPI_COMM_WORLD);
  return mask;
}

double largest_difference(const std::vector<Vector3d>& a, const std::vector<Vector3d>& b) {
  double most = 0;
  for (std::size_t k = 0; k < a.size(); ++k) most = std::max(most, (a[k] - b[k]).norm());
  return most;
}

class Bed {
 public:
  explicit Bed(const std::string& kind, double rest_s = 5.0)
      : scene_("bed_" + kind), rock_(setup(kind, rest_s), MPI_COMM_WORLD) {
    rock_.place({paddle_});
  }

  core::RockState step() { return rock_.step({kSteps, {paddle_}}); }
  core::RockState step_to(double z) {
    paddle_.p.z() = z;
    return step();
  }
  Vector3d floor_force() {
    LAMMPS_NS::Modify* modify = rock_.liggghts().modify;
    LAMMPS_NS::Fix* floor = modify->fix[modify->find_fix("floor")];
    return {floor->compute_vector(0), floor->compute_vector(1), floor->compute_vector(2)};
  }
  double channel(const core::RockState& s, const std::string& name) const {
    const auto channels = rock_.info().channels;
    for (std::size_t k = 0; k < channels.size(); ++k)
      if (channels[k].name == name) return s.channels[k];
    return std::nan("");
  }
  LiggghtsRock& rock() { return rock_; }

 private:
  setup::RockSetup setup(const std::string& kind, double rest_s) const {
    setup::RockSetup s = scene_.bed(kind);
    setup::HoldSettings& hold = s.hold.emplace();
    // Nothing is ever too fast, so all of it is held at the same time, and by then it is at rest.
    hold.below_m_s = 20;
    hold.rest_s = rest_s;
    return s;
  }

  test::Scene scene_;
  LiggghtsRock rock_;
  Pose paddle_{Quaterniond::Identity(), Vector3d(0, 0, 7)};
};

class Hold : public testing::TestWithParam<const char*> {};

TEST_P(Hold, KeepsStressAndPlace) {
  Bed bed(GetParam());
  LAMMPS_NS::LAMMPS& lmp = bed.rock().liggghts();
  const test::Momentum all = test::momentum(lmp);
  ASSERT_GT(all.mass, 800);
  ASSERT_GE(all.bodies, std::string(GetParam()) == "multispheres" ? 20 : 0);
  const double weight = all.mass * 9.81;

  // Until the first rock is parked, and on until all is.
  Spheres before;
  Vector3d floor_before = Vector3d::Zero();
  core::RockState s = bed.step(), last;
  int windows = 0;
  for (double parked = 0; parked == 0 && windows < 1200; ++windows) {
    before = spheres(lmp);
    floor_before = bed.floor_force();
    last = s;
    s = bed.step();
    parked = bed.channel(s, "rock_parked");
  }
  ASSERT_LT(windows, 1200) << "the bed did not come to rest";
  for (int k = 0; k < 100; ++k) s = bed.step();  // 1 s
  EXPECT_NEAR(bed.channel(s, "rock_parked"), all.mass, 1e-6) << "all of it is out";
  EXPECT_NEAR(bed.channel(s, "rock_mass"), all.mass, 1e-6) << "and is still counted";
  EXPECT_EQ(bed.channel(s, "rocks"), all.bodies);

  bed.rock().state_hash();  // brings all of it back
  const Spheres woken = spheres(lmp);
  const double moved = largest_difference(before.x, woken.x);
  const double jolt = largest_difference(before.f, woken.f) / weight;
  const double energy_before = bed.channel(last, "rock_kinetic_energy");
  double energy = 0;  // free again: it comes to rest anew only after 0.3 s
  for (int k = 0; k < 20; ++k) {
    s = bed.step();
    energy = std::max(energy, bed.channel(s, "rock_kinetic_energy"));
  }
  const double floor = (bed.floor_force() - floor_before).norm() / weight;
  const double settled = largest_difference(woken.x, spheres(lmp).x);
  // Against the fall of all rock by a tenth of a radius: what lost friction would set free.
  const double scale = weight * 0.01;
  if (test::rank() == 0) {
    fmt::print(
        "{}: {:.0f} kg at rest after {} windows; held 1 s: moved {:.1e} m, forces off by "
        "{:.1e} and floor by {:.1e} of the weight; woken: {:.1e} of the energy scale (before "
        "{:.1e}), {:.1e} m\n",
        GetParam(), all.mass, windows, moved, jolt, floor, energy / scale, energy_before / scale,
        settled);
  }
  EXPECT_LT(moved, 1e-5);  // on two ranks, what changes ranks is held a little later
  // What the velocities gave through damping, and the chatter of the rolling model, is gone.
  EXPECT_LT(jolt, 2e-3);
  EXPECT_LT(floor, 5e-3);
  EXPECT_LT(energy / scale, 1e-6);
  EXPECT_LT(settled, 5e-4);
}

TEST_P(Hold, EndsWhereTheWallComes) {
  Bed bed(GetParam());
  core::RockState s;
  const double mass = test::momentum(bed.rock().liggghts()).mass;
  int windows = 0;
  do s = bed.step();
  while (bed.channel(s, "rock_parked") < mass - 1e-6 && ++windows < 1200);
  ASSERT_LT(windows, 1200);
  double z = 7, least = mass;
  while (z > 0.8) {  // 2 m/s, into the bed
    s = bed.step_to(z -= 0.02);
    least = std::min(least, bed.channel(s, "rock_parked"));
  }
  EXPECT_LT(least, 0.7 * mass) << "rock under the paddle is awake";
  EXPECT_GT(s.bodies[0].mean.force.z(), 1000) << "and pushes back";
}

// Held as it falls and bounces, and woken, again and again: some rock has just crossed from rank to
// rank each time, and all must move again.
TEST_P(Hold, GivesAllRockBackToTheIntegrators) {
  Bed bed(GetParam(), 0.05);
  LAMMPS_NS::LAMMPS& lmp = bed.rock().liggghts();
  const std::vector<int> before = groups(lmp);
  for (int cycle = 0; cycle < 20; ++cycle) {
    core::RockState s;
    for (int k = 0; k < 13; ++k) s = bed.step();
    EXPECT_GT(bed.channel(s, "rock_parked"), 0) << "cycle " << cycle;
    bed.rock().state_hash();  // wakes all of it
    ASSERT_EQ(groups(lmp), before) << "cycle " << cycle;
  }
}

INSTANTIATE_TEST_SUITE_P(Rock, Hold, testing::Values("spheres", "multispheres"),
                         [](const auto& kind) { return std::string(kind.param); });

}  // namespace
}  // namespace dipper::dem
