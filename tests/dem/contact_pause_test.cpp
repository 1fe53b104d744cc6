// A wall that pauses goes through rock as if it were not there; then what is in its steel is gone.
#include "dem/contact_pause.hpp"

#include <gtest/gtest.h>

#include "dem/liggghts_rock.hpp"
#include "tests/dem/momentum.hpp"
#include "tests/dem/scene.hpp"

namespace dipper::dem {
namespace {

const Pose kFar{Quaterniond::Identity(), {0, 0, 7}};
const Pose kIn{Quaterniond::Identity(), {0, 0, 0.35}};

class ContactPause : public testing::TestWithParam<const char*> {
 protected:
  const std::string kind_ = GetParam();
  const test::Scene scene_{"pause_" + kind_};
  const std::filesystem::path bed_ = scene_.folder() / "bed.restart";

  void SetUp() override {
    LiggghtsRock rock(scene_.bed(kind_), MPI_COMM_WORLD);
    rock.place({kFar});
    for (int k = 0; k < 30; ++k) rock.step({100, {kFar}});
    rock.save(bed_);
  }

  std::string block() const {
    return scene_.stl("block", test::box({-0.3, -0.3, -0.3}, {0.3, 0.3, 0.3}));
  }

  setup::RockSetup dig() const {
    setup::RockSetup setup = scene_.setup("clear.in");
    setup.bodies = {"block"};
    setup.variables.push_back({"clumps", kind_ == "multispheres" ? "1" : "0"});
    setup.variables.push_back({"restart", bed_.string()});
    setup.variables.push_back({"block", block()});
    return setup;
  }

  /// Lets the block down into the bed in ten windows, and stays there for ten more. The largest
  /// force on it in the first ten, in the others; the fastest rock of all.
  struct Seen {
    double going_in_N = 0, there_N = 0, speed_m_s = 0;
    core::RockState last;
  };
  static Seen let_down(LiggghtsRock& rock, bool pause) {
    Seen seen;
    rock.place({kFar});
    for (int k = 1; k <= 20; ++k) {
      Pose X = kFar;
      X.p += std::min(1.0, 0.1 * k) * (kIn.p - kFar.p);
      seen.last = rock.step({50, {X}, !pause || k > 10});
      double& force = k <= 10 ? seen.going_in_N : seen.there_N;
      force = std::max(force, seen.last.bodies[0].end.force.norm());
      const double mass = channel(rock, seen.last, "rock_mass");
      seen.speed_m_s = std::max(
          seen.speed_m_s, std::sqrt(2 * channel(rock, seen.last, "rock_kinetic_energy") / mass));
    }
    return seen;
  }

  static double channel(const LiggghtsRock& rock, const core::RockState& s, const char* name) {
    return s.channels[core::channel_index(rock.info(), name)];
  }
};

TEST_P(ContactPause, GoesThroughRockAndClearsWhatIsInItsSteel) {
  setup::RockSetup setup = dig();
  double pushed_N = 0;
  {
    LiggghtsRock rock(setup, MPI_COMM_WORLD);
    pushed_N = let_down(rock, false).going_in_N;
  }
  setup.pauses = true;
  LiggghtsRock rock(setup, MPI_COMM_WORLD);
  const test::Momentum before = test::momentum(rock.liggghts());
  const Seen seen = let_down(rock, true);
  const test::Momentum after = test::momentum(rock.liggghts());
  EXPECT_GT(pushed_N, 1e3) << "without a pause";
  EXPECT_EQ(seen.going_in_N, 0);
  EXPECT_LT(seen.there_N, 0.05 * pushed_N) << "rock falls against it, none is shot out";
  EXPECT_LT(seen.speed_m_s, 2);
  const double gone = channel(rock, seen.last, "cleared_overlap");
  EXPECT_GT(gone, 0.02 * before.mass);
  EXPECT_NEAR(before.mass - after.mass, gone, 1e-9 * before.mass);
  EXPECT_EQ(channel(rock, seen.last, "cleared_floor"), 0);
}

TEST_P(ContactPause, ClearsTheFloorWhenAsked) {
  setup::RockSetup setup = dig();
  setup.pauses = true;
  setup.floor = setup::FloorStrip{-0.5, 10, 10};
  LiggghtsRock rock(setup, MPI_COMM_WORLD);
  const test::Momentum before = test::momentum(rock.liggghts());
  const Seen seen = let_down(rock, true);
  const double floor = channel(rock, seen.last, "cleared_floor");
  EXPECT_GT(floor, 0.05 * before.mass);
  EXPECT_NEAR(before.mass - test::momentum(rock.liggghts()).mass,
              floor + channel(rock, seen.last, "cleared_overlap"), 1e-9 * before.mass);
}

TEST_P(ContactPause, ACheckpointKnowsThatItIsPaused) {
  setup::RockSetup setup = dig();
  setup.pauses = true;
  const auto saved = scene_.folder() / "paused.restart";
  Pose X = kFar;
  core::RockState at;
  {
    LiggghtsRock rock(setup, MPI_COMM_WORLD);
    rock.place({kFar});
    X.p = kIn.p;
    at = rock.step({250, {X}, false});
    rock.save(saved);
  }
  setup.resumed = {{at.bodies[0].end, Twist{}}};
  setup.image = setup::image_of(saved);
  for (auto& [name, value] : setup.variables)
    if (name == "restart") value = saved.string();
  LiggghtsRock rock(setup, MPI_COMM_WORLD);
  rock.place({at.bodies[0].X_WB});
  // The pause ends here: that there was one only the checkpoint knows.
  EXPECT_GT(channel(rock, rock.step({50, {at.bodies[0].X_WB}}), "cleared_overlap"), 0);
}

TEST_P(ContactPause, IsRefusedWhereTheSetUpHasNoneInIt) {
  LiggghtsRock rock(dig(), MPI_COMM_WORLD);
  rock.place({kFar});
  EXPECT_THROW(rock.step({50, {kFar}, false}), std::runtime_error);
  rock.step({50, {kFar}});
}

INSTANTIATE_TEST_SUITE_P(Rock, ContactPause, testing::Values("spheres", "multispheres"),
                         [](const auto& kind) { return std::string(kind.param); });

TEST(ContactPauseSetup, GoesToTheProcessAndBack) {
  setup::RockSetup setup;
  setup.pauses = true;
  setup.floor = setup::FloorStrip{13, 8, 3};
  const setup::RockSetup back = setup::rock_setup_from(to_json(setup));
  EXPECT_TRUE(back.pauses);
  ASSERT_TRUE(back.floor);
  EXPECT_EQ(back.floor->half_width_m, 8);
}

}  // namespace
}  // namespace dipper::dem
