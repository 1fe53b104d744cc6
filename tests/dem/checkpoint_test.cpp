// A checkpoint changes nothing: a run that saves is the run that does not, to the bit; and a run
// that goes on from one meets the same forces.
#include <atom.h>
#include <fix_multisphere.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <lammps.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "dem/liggghts_rock.hpp"
#include "dem/parked_rock.hpp"
#include "tests/dem/scene.hpp"
#include "tests/dem/spheres.hpp"

namespace dipper::dem {
namespace {

constexpr int kSteps = 20, kWindows = 240, kSaved = 200, kSoon = 20;

/// Rock falls into a bin and a paddle goes down into it at 2 m/s.
class Scenario {
 public:
  Scenario(const std::string& kind, bool hold) : scene_("checkpoint"), kind_(kind), hold_(hold) {}

  /// One instance of LIGGGHTS, from the start or from a checkpoint.
  std::unique_ptr<LiggghtsRock> begin() {
    auto rock = std::make_unique<LiggghtsRock>(setup(), MPI_COMM_WORLD);
    rock->place({paddle(0)});
    info = rock->info();
    return rock;
  }
  std::unique_ptr<LiggghtsRock> resume(const core::BodyLoad& at, const Twist& V_WB_W) const {
    setup::RockSetup s = setup();
    s.variables.insert(s.variables.begin(), {"resumed", kind_ == "spheres" ? "1" : "2"});
    s.variables.push_back({"restart", file().string()});
    s.resumed = {{at.end, V_WB_W}};
    s.image = setup::image_of(file());
    auto rock = std::make_unique<LiggghtsRock>(s, MPI_COMM_WORLD);
    rock->place({at.X_WB});
    return rock;
  }
  core::ServerInfo info;  ///< once begun
  static Pose paddle(int windows) {
    return {Quaterniond::Identity(), Vector3d(0.05, 0, 1.6 - 2.0 * windows * kSteps * 1e-4)};
  }
  std::filesystem::path file() const { return scene_.folder() / "rock.restart"; }

 private:
  setup::RockSetup setup() const {
    setup::RockSetup s = scene_.bed(kind_);
    if (hold_) s.hold = test::lively_hold();
    return s;
  }

  test::Scene scene_;
  std::string kind_;
  bool hold_;
};

class Checkpoint : public testing::TestWithParam<std::tuple<const char*, bool>> {};

double peak(const std::vector<core::RockState>& states) {
  double most = 0;
  for (const auto& s : states) most = std::max(most, s.bodies[0].mean.force.norm());
  return most;
}

TEST_P(Checkpoint, ChangesNothing) {
  const auto [kind, hold] = GetParam();
  Scenario scenario(kind, hold);
  std::vector<core::RockState> plain;
  std::string hash;
  Spheres at_saved, soon;
  {
    const auto rock = scenario.begin();
    for (int k = 1; k <= kWindows; ++k) {
      plain.push_back(rock->step({kSteps, {Scenario::paddle(k)}}));
      if (k == kSaved + 1) soon = spheres(rock->liggghts());
    }
    hash = rock->state_hash();
  }
  if (hold) {
    EXPECT_GT(plain[kSaved - 1].channels[core::channel_index(scenario.info, "rock_parked")], 0)
        << "nothing is parked";
  }
  const double force = peak(plain);
  ASSERT_GT(force, 1000) << "the paddle has met rock";
  {
    const auto rock = scenario.begin();
    for (int k = 1; k <= kWindows; ++k) {
      const core::RockState s = rock->step({kSteps, {Scenario::paddle(k)}});
      ASSERT_EQ(s.bodies[0].mean.force, plain[k - 1].bodies[0].mean.force) << "window " << k;
      ASSERT_EQ(s.channels, plain[k - 1].channels) << "window " << k;
      if (k <= kSaved) rock->save(scenario.file());  // every window; the last is gone on from
    }
    EXPECT_EQ(rock->state_hash(), hash);
  }
  const core::BodyLoad& at = plain[kSaved - 1].bodies[0];
  const Twist V_WB_W = twist_between(plain[kSaved - 2].bodies[0].X_WB, at.X_WB, kSteps * 1e-4);
  const auto rock = scenario.resume(at, V_WB_W);
  double first = 0, later = 0, moved = 0;
  for (int k = kSaved + 1; k <= kSaved + kSoon; ++k) {
    const core::RockState s = rock->step({kSteps, {Scenario::paddle(k)}});
    const core::RockState& was = plain[k - 1];
    EXPECT_EQ(s.step, was.step);
    const double off = (s.bodies[0].mean.force - was.bodies[0].mean.force).norm() / force;
    (k == kSaved + 1 ? first : later) = std::max(k == kSaved + 1 ? first : later, off);
    if (k > kSaved + 1) continue;
    const Spheres now = spheres(rock->liggghts());
    for (std::size_t n = 0; n < now.x.size(); ++n)
      moved = std::max(moved, (now.x[n] - soon.x[n]).norm());
    EXPECT_EQ(s.channels.size(), was.channels.size());
  }
  if (test::rank() == 0)
    fmt::print(
        "{}{}: resumed: force off by {:.1e} of the peak of {:.0f} N in the next window, by "
        "{:.1e} in {} windows, spheres by {:.1e} m\n",
        kind, hold ? " held" : "", first, force, later, kSoon, moved);
  EXPECT_LT(first, 1e-12);
  EXPECT_LT(moved, 1e-12);

  // With all rock back, LIGGGHTS's maps of ids reach to the largest, as they did not when that one
  // was parked at the checkpoint.
  rock->state_hash();
  LAMMPS_NS::Atom& atom = *rock->liggghts().atom;
  EXPECT_GE(atom.map_tag_max, atom.tag_max());
  if (LAMMPS_NS::FixMultisphere* fix = multisphere_of(rock->liggghts())) {
    for (int b = 0; b < fix->data().n_body(); ++b)
      EXPECT_EQ(fix->data().map(fix->data().tag(b)), b);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Rock, Checkpoint, testing::Combine(testing::Values("spheres", "multispheres"), testing::Bool()),
    [](const auto& p) {
      return std::string(std::get<0>(p.param)) + (std::get<1>(p.param) ? "_held" : "");
    });

}  // namespace
}  // namespace dipper::dem
