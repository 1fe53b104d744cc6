// The held layer: it does not move, it carries the rest, and what it takes from the moving rock's
// momentum is what it feels. The bin is one mesh, so every force is known.
#include <fix.h>
#include <fmt/format.h>
#include <group.h>
#include <gtest/gtest.h>
#include <input.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "dem/hold.hpp"
#include "dem/liggghts_rock.hpp"
#include "tests/dem/momentum.hpp"
#include "tests/dem/scene.hpp"
#include "tests/dem/spheres.hpp"

namespace dipper::dem {
namespace {

constexpr double kDepth = 0.3, kHalf = 0.75, kDt = 1e-4;
const Vector3d kGravity(0, 0, -9.81);

class Layer {
 public:
  /// With `frames`, a dump is written each 100 steps: each window of step_to.
  explicit Layer(const std::string& kind, bool frames = false)
      : scene_("layer_" + kind), rock_(setup(kind), MPI_COMM_WORLD) {
    if (frames) {
      const std::string file = (scene_.folder() / "frames.dump").string();
      rock_.liggghts().input->one(("dump frames all custom 100 " + file + " id x y z").c_str());
    }
    rock_.place({paddle_});
    const Spheres s = spheres(rock_.liggghts(), kGravity);
    in_.resize(s.x.size());
    for (std::size_t k = 0; k < in_.size(); ++k) {
      const Vector3d& p = s.x[k];
      in_[k] = p.norm() > 0 &&
               (p.z() < kDepth || p.x() > kHalf - kDepth || std::abs(p.y()) > kHalf - kDepth);
    }
  }
  core::RockState step(int steps) { return rock_.step({steps, {paddle_}}); }
  core::RockState step_to(double z) {
    paddle_.p.z() = z;
    return step(100);
  }
  /// Of the bin, on the rock.
  Vector3d bin() {
    LAMMPS_NS::Modify* modify = rock_.liggghts().modify;
    LAMMPS_NS::Fix* wall = modify->fix[modify->find_fix("floor")];
    return -Vector3d(wall->compute_vector(0), wall->compute_vector(1), wall->compute_vector(2));
  }
  /// Of all else on the layer.
  Vector3d on_layer(const Spheres& s) const {
    Vector3d sum = Vector3d::Zero();
    for (std::size_t k = 0; k < in_.size(); ++k)
      if (in_[k]) sum += s.f[k];
    return sum;
  }
  double mass_of_layer() {
    const LAMMPS_NS::Atom& atom = *rock_.liggghts().atom;
    double m = 0;
    for (int i = 0; i < atom.nlocal; ++i)
      if (in_[static_cast<std::size_t>(atom.tag[i])]) m += atom.rmass[i];
    MPI_Allreduce(MPI_IN_PLACE, &m, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    return m;
  }
  /// Spheres that are held still.
  double held() {
    const LAMMPS_NS::LAMMPS& lmp = rock_.liggghts();
    const int bit = lmp.group->bitmask[lmp.group->find(kLayerGroup)];
    double n = 0;
    for (int i = 0; i < lmp.atom->nlocal; ++i) n += (lmp.atom->mask[i] & bit) != 0;
    MPI_Allreduce(MPI_IN_PLACE, &n, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    return n;
  }
  /// How far the rock of the layer, and the other, has moved from `from` at most.
  std::pair<double, double> moved(const Spheres& from) {
    const Spheres now = spheres(rock_.liggghts(), kGravity);
    double layer = 0, other = 0;
    for (std::size_t k = 0; k < in_.size(); ++k) {
      double& most = in_[k] ? layer : other;
      most = std::max(most, (now.x[k] - from.x[k]).norm());
    }
    return {layer, other};
  }
  LiggghtsRock& rock() { return rock_; }
  const std::filesystem::path& folder() const { return scene_.folder(); }

 private:
  setup::RockSetup setup(const std::string& kind) const {
    mesh::TriangleMesh bin;  // inside the deck's planes, which nothing reaches
    const auto plate = [&](const Vector3d& low, const Vector3d& high) {
      const mesh::TriangleMesh part = test::box(low, high);
      for (std::size_t i = 0; i < part.triangles.size(); ++i) bin.add_loose(part.corners(i));
    };
    const double t = 0.02, h = kHalf, top = 1.4;
    plate({-h, -h, -0.3}, {h, h, 0});
    plate({-h - t, -h, 0.01}, {-h, h, top});
    plate({h, -h, 0.01}, {h + t, h, top});
    plate({-h, -h - t, 0.01}, {h, -h, top});
    plate({-h, h, 0.01}, {h, h + t, top});
    setup::RockSetup s = scene_.setup("bed.in");
    s.bodies = {"paddle"};
    s.variables.push_back({"rock", kind});
    s.variables.push_back({"floor", scene_.stl("floor", bin)});
    s.variables.push_back(
        {"paddle", scene_.stl("paddle", test::box({-0.3, -0.3, -0.3}, {0.3, 0.3, 0.3}))});
    s.layer = setup::HeldLayer{kDepth, kHalf, kHalf};
    return s;
  }

  test::Scene scene_;
  LiggghtsRock rock_;
  Pose paddle_{Quaterniond::Identity(), Vector3d(0, 0, 7)};
  std::vector<bool> in_;
};

TEST(HeldLayer, StandsStillCarriesTheRestAndBalancesItsMomentum) {
  Layer bed("spheres");
  LAMMPS_NS::LAMMPS& lmp = bed.rock().liggghts();
  const Spheres start = spheres(lmp, kGravity);
  const double all = test::momentum(lmp).mass, layer = bed.mass_of_layer(), free = all - layer;
  ASSERT_GT(layer, 0.2 * all);
  ASSERT_GT(free, 0.05 * all);

  // Velocity Verlet, a step: P1 - P0 = dt/2 (F0 + F1), F what the bin and gravity do to all rock
  // less what the layer keeps to itself.
  Spheres now = start;
  Vector3d f0 = bed.bin() - bed.on_layer(now) + free * kGravity;
  Vector3d p0 = test::momentum(lmp).linear;
  double worst = 0, hardest = 0;
  bed.step(1);  // the bin's force is known from the first step on
  now = spheres(lmp, kGravity);
  f0 = bed.bin() - bed.on_layer(now) + free * kGravity;
  p0 = test::momentum(lmp).linear;
  for (int k = 0; k < 3000; ++k) {
    bed.step(1);
    now = spheres(lmp, kGravity);
    const Vector3d f1 = bed.bin() - bed.on_layer(now) + free * kGravity;
    const Vector3d p1 = test::momentum(lmp).linear;
    const double scale = kDt * std::max(free * 9.81, bed.on_layer(now).norm());
    worst = std::max(worst, (p1 - p0 - kDt / 2 * (f0 + f1)).norm() / scale);
    hardest = std::max(hardest, bed.on_layer(now).norm());
    f0 = f1;
    p0 = p1;
  }
  const Vector3d before = bed.on_layer(start);
  for (int k = 0; k < 300; ++k) bed.step(100);
  now = spheres(lmp, kGravity);
  const auto [layer_moved, free_moved] = bed.moved(start);
  const double carried = -(bed.on_layer(now) - before).z() / (free * 9.81);
  if (test::rank() == 0)
    fmt::print(
        "{:.0f} of {:.0f} kg held: moved {:.1e} m, the rest {:.2f} m; carries {:.4f} of its "
        "weight; momentum off by {:.1e}\n",
        layer, all, layer_moved, free_moved, carried, worst);
  EXPECT_EQ(layer_moved, 0);
  EXPECT_GT(free_moved, 0.1);
  EXPECT_LT(worst, 1e-8);   // the requirement
  EXPECT_LT(worst, 1e-10);  // the regression
  EXPECT_GT(carried, 0.5);
  EXPECT_LT(carried, 1.01);
}

TEST(HeldLayer, EndsWhereTheWallComesWithAFrameAWindow) {
  Layer bed("spheres", true);
  const double first = bed.held();
  ASSERT_GT(first, 10);
  for (double z = 7; z > 0.8;) bed.step_to(z -= 0.02);
  EXPECT_LT(bed.held(), 0.7 * first);
}

class HeldLayerOf : public testing::TestWithParam<const char*> {};

TEST_P(HeldLayerOf, IsTheSameAfterACheckpointAndEndsWhereTheWallComes) {
  Layer bed(GetParam());
  LAMMPS_NS::LAMMPS& lmp = bed.rock().liggghts();
  const double first = bed.held();
  ASSERT_GT(first, 10);
  for (int k = 0; k < 100; ++k) bed.step(100);
  bed.rock().state_hash();  // brings all rock in
  const Spheres before = spheres(lmp, kGravity);
  bed.rock().save(bed.folder() / "bed.restart");
  EXPECT_EQ(bed.held(), first);
  for (int k = 0; k < 50; ++k) bed.step(100);
  bed.rock().state_hash();
  EXPECT_EQ(bed.held(), first);
  // All that was held is where it was.
  const Spheres after = spheres(lmp, kGravity);
  const int bit = lmp.group->bitmask[lmp.group->find(kLayerGroup)];
  double most = 0;
  for (int i = 0; i < lmp.atom->nlocal; ++i) {
    const auto tag = static_cast<std::size_t>(lmp.atom->tag[i]);
    if ((lmp.atom->mask[i] & bit) != 0)
      most = std::max(most, (after.x[tag] - before.x[tag]).norm());
  }
  MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
  EXPECT_EQ(most, 0);
  core::RockState s;
  for (double z = 7; z > 0.8;) s = bed.step_to(z -= 0.02);  // 2 m/s, into the bed
  bed.rock().state_hash();
  EXPECT_LT(bed.held(), 0.7 * first) << "rock under the paddle is free";
  EXPECT_GT(s.bodies[0].mean.force.z(), 1000) << "and pushes back";
}

INSTANTIATE_TEST_SUITE_P(Rock, HeldLayerOf, testing::Values("spheres", "multispheres"),
                         [](const auto& kind) { return std::string(kind.param); });

}  // namespace
}  // namespace dipper::dem
