// What the master relies on: predictions leave no trace, checkpoints lose nothing, faults are
// named.
#include <gmock/gmock.h>

#include <cstring>
#include <fstream>
#include <limits>
#include <stdexcept>

#include "common/input_error.hpp"
#include "mbs/feeling_operator.hpp"
#include "mbs/program_operator.hpp"
#include "tests/mbs/shovel_fixture.hpp"

namespace dipper::mbs {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// Every number of a machine state, to compare bit by bit.
std::vector<double> bits(const core::MachineState& s) {
  std::vector<double> v = s.channels;
  for (const BodyState& b : s.bodies) {
    v.insert(v.end(), b.X_WB.R.coeffs().data(), b.X_WB.R.coeffs().data() + 4);
    for (const Vector3d& x : {b.X_WB.p, b.V_WB_W.w, b.V_WB_W.v})
      v.insert(v.end(), x.data(), x.data() + 3);
  }
  return v;
}

bool same(const core::MachineState& a, const core::MachineState& b) {
  const auto x = bits(a), y = bits(b);
  return a.t_ns == b.t_ns && x.size() == y.size() &&
         std::memcmp(x.data(), y.data(), x.size() * sizeof(double)) == 0;
}

class ShovelState : public ShovelTest, public testing::WithParamInterface<machine::DriveMode> {
 protected:
  /// With limited drives the hoist cannot lift the load: operator and stall take part.
  Shovel another() {
    machine::MachineData weak = machine;
    weak.drives.hoist.stall = 6e5;
    return Shovel(weak, quick(), Pose{}, rake, kLongestSubstep_ns, GetParam());
  }
  Shovel shovel = another();

  static std::vector<Wrench> load(int i) {
    return {Wrench{Vector3d(0, -1e5 - 100 * i, 0), Vector3d(-2e5, 1e3 * i, -3e5)},
            Wrench{Vector3d::Zero(), Vector3d(-1e4, 0, 0)}};
  }
  static std::int64_t window(int i) { return 1'700'000LL * i; }  // not a divisor of anything

  std::filesystem::path file(const std::string& name) const {
    return std::filesystem::path(testing::TempDir()) / name;
  }
};

TEST_P(ShovelState, AnnouncesBodiesAndChannels) {
  const core::ServerInfo info = shovel.info();
  EXPECT_THAT(info.bodies, ElementsAre("dipper", "door"));
  EXPECT_THAT(info.version, HasSubstr("Simbody 3.7"));
  const core::MachineState s = shovel.state(0);
  EXPECT_EQ(s.t_ns, 0);
  EXPECT_EQ(s.bodies.size(), info.bodies.size());
  EXPECT_EQ(s.channels.size(), info.channels.size());
  std::map<std::string, int> seen;
  for (const core::Channel& c : info.channels) EXPECT_EQ(++seen[c.name], 1) << c.name;
}

TEST_P(ShovelState, AskingWhereItWillBeChangesNothing) {
  Shovel plain = another();
  for (int i = 1; i <= 300; ++i) {
    core::MachineState asked = shovel.step({window(i), load(i), window(i + 1)});
    EXPECT_EQ(asked.X_WB_next.size(), 2u);
    shovel.state(window(i + 2));
    asked.X_WB_next.clear();
    ASSERT_TRUE(same(asked, plain.step({window(i), load(i)}))) << i;
  }
}

// The joints that are free go on with the acceleration they have: an error of third order.
TEST_P(ShovelState, WhereItWillBeIsExtrapolated) {
  for (int i = 1; i <= 2000; ++i) shovel.step({2 * i * kMillisecond, load(0)});
  shovel.save(file("ahead.bin"));
  const auto off = [&](std::int64_t h_ns) {
    Shovel now = another();
    now.load(file("ahead.bin"));
    const std::int64_t t_ns = 4000 * kMillisecond + h_ns;
    const std::vector<Pose> ahead = now.state(t_ns).X_WB_next;
    return distance(ahead.at(0), now.step({t_ns, load(0)}).bodies[0].X_WB).metres;
  };
  EXPECT_LT(off(1'000'000), 1e-7);
  EXPECT_GT(std::log2(off(2'000'000) / off(1'000'000)), 2.5);
}

TEST_P(ShovelState, SaveAndLoadContinueBitIdentically) {
  for (int i = 1; i <= 400; ++i) shovel.step({window(i), load(i)});
  shovel.save(file("shovel.bin"));
  Shovel other = another();
  other.load(file("shovel.bin"));
  EXPECT_TRUE(same(shovel.state(0), other.state(0)));
  for (int i = 401; i <= 800; ++i) {
    ASSERT_TRUE(same(shovel.step({window(i), load(i)}), other.step({window(i), load(i)})));
  }
}

TEST_P(ShovelState, KeepsTheRowsItsMotionHasGoneOnWith) {
  const std::string more = "1.3,-4.1,0.5,0,0\n1.5,-4.1,0.5,0,0\n",
                    last = "1.9,-4,0.5,0,0\n2.3,-4,0.5,1,0\n";
  const auto planned = [&] {
    return Shovel(machine, still(), Pose{}, rake, kLongestSubstep_ns, GetParam());
  };
  Shovel one = planned();
  one.follow(more);
  for (int i = 1; i <= 800; ++i) one.step({window(i), no_rock});
  one.save(file("rows.bin"));
  Shovel other = planned();
  other.load(file("rows.bin"));
  for (int i = 801; i <= 900; ++i)
    ASSERT_TRUE(same(one.step({window(i), no_rock}), other.step({window(i), no_rock}))) << i;
  EXPECT_NEAR(named(one, one.state(0)).at("hoist"), -4.1, 0.05);
  for (Shovel* each : {&one, &other}) each->follow(last);  // what is loaded goes on like it
  for (int i = 901; i <= 1400; ++i)
    ASSERT_TRUE(same(one.step({window(i), no_rock}), other.step({window(i), no_rock}))) << i;
  EXPECT_NEAR(named(one, one.state(0)).at("hoist"), -4, 0.05);
  EXPECT_THROW(one.follow(more), InputError) << "its time is past";

  // And without rows what was loaded before is forgotten.
  planned().save(file("none.bin"));
  other.load(file("none.bin"));
  for (int i = 1; i <= 800; ++i) other.step({window(i), no_rock});
  EXPECT_NEAR(named(other, other.state(0)).at("hoist"), -4, 0.01) << "it stands";

  const auto size = std::filesystem::file_size(file("rows.bin"));
  std::filesystem::resize_file(file("rows.bin"), size - 8);
  EXPECT_THAT([&] { other.load(file("rows.bin")); },
              ThrowsMessage<std::runtime_error>(HasSubstr("ends too early")));
  std::filesystem::resize_file(file("rows.bin"), size + 1);
  EXPECT_THAT([&] { other.load(file("rows.bin")); },
              ThrowsMessage<std::runtime_error>(HasSubstr("longer than a saved shovel")));
}

// The door both rides on the dipper and is driven: its twist is checked against its poses.
TEST_P(ShovelState, TwistIsTheRateOfThePose) {
  for (int i = 1; i <= 2000; ++i) shovel.step({2 * i * kMillisecond, load(0)});
  const BodyState a = shovel.state(0).bodies[1];
  const BodyState b = shovel.step({4001 * kMillisecond, load(0)}).bodies[1];
  const Twist mean = twist_between(a.X_WB, b.X_WB, 1e-3);
  EXPECT_LT((mean.v - 0.5 * (a.V_WB_W.v + b.V_WB_W.v)).norm(), 1e-5);
  EXPECT_LT((mean.w - 0.5 * (a.V_WB_W.w + b.V_WB_W.w)).norm(), 1e-5);
}

TEST_P(ShovelState, RefusesWhatIsNotFinite) {
  shovel.step({window(1), load(1)});
  std::vector<Wrench> bad = load(1);
  bad[1].force.y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(
      [&] {
        shovel.step({window(2), bad});
      },
      ThrowsMessage<std::runtime_error>(testing::AllOf(
          HasSubstr("the wrench on the door is not finite"), HasSubstr("0.001700 to 0.003400 s"))));
  bad = load(1);
  bad[0].force.z() = 1e300;
  EXPECT_THAT(
      [&] {
        shovel.step({window(2), bad});
      },
      ThrowsMessage<std::runtime_error>(HasSubstr("while stepping from 0.001700")));
  // And it is still usable.
  EXPECT_EQ(shovel.step({window(2), load(2)}).t_ns, window(2));
}

TEST_P(ShovelState, RefusesWrongCalls) {
  EXPECT_THROW(shovel.step({0, load(0)}), std::invalid_argument);
  EXPECT_THROW(shovel.step({window(1), {Wrench{}}}), std::invalid_argument);
  EXPECT_THROW(Shovel(machine, quick(), Pose{}, rake, 0), std::invalid_argument);
  EXPECT_THROW(Shovel(machine, motion("1,-4,0,0,0\n2,-4,0,0,0\n"), Pose{}, rake),
               std::invalid_argument);
}

TEST_P(ShovelState, RefusesAForeignOrBrokenFile) {
  EXPECT_THROW(shovel.load(file("not-there.bin")), std::runtime_error);
  std::ofstream(file("foreign.bin")) << "something else entirely";
  EXPECT_THAT([&] { shovel.load(file("foreign.bin")); },
              ThrowsMessage<std::runtime_error>(HasSubstr("not a saved shovel")));
  shovel.save(file("short.bin"));
  const auto size = std::filesystem::file_size(file("short.bin"));
  std::filesystem::resize_file(file("short.bin"), size - 8);
  EXPECT_THAT([&] { shovel.load(file("short.bin")); },
              ThrowsMessage<std::runtime_error>(HasSubstr("ends too early")));
  std::filesystem::resize_file(file("short.bin"), size + 8);
  EXPECT_THROW(shovel.load(file("short.bin")), std::runtime_error);
  EXPECT_EQ(shovel.state(0).t_ns, 0);
}

// An operator who feels the dig: weak hoist, so that the dipper is caught, weighed and lifted.
TEST_F(ShovelTest, AnOperatorWhoFeelsGoesOnFromACheckpointToTheBit) {
  const auto file = std::filesystem::path(testing::TempDir()) / "feeling.bin";
  const auto another = [&] {
    const auto way = std::make_shared<machine::Motion>(quick());
    return Shovel(machine, way, Pose{}, rake,
                  std::make_unique<FeelingOperator>(way, machine, rake, 80e3));
  };
  const std::vector<Wrench> under = {Wrench{Vector3d(0, -2.4e6, 0), Vector3d(0, 0, 6e5)}, Wrench{}};
  Shovel one = another();
  for (int i = 1; i <= 400; ++i) one.step({2 * i * kMillisecond, under});
  EXPECT_GT(named(one, one.state(0)).at("hoist_lift"), 0.05) << "the dipper stands on rock";
  one.save(file);
  Shovel other = another();
  other.load(file);
  for (int i = 401; i <= 700; ++i)
    ASSERT_TRUE(same(one.step({2 * i * kMillisecond, no_rock}),
                     other.step({2 * i * kMillisecond, no_rock})));
  const auto led = [&](std::unique_ptr<Operator> by) {
    return Shovel(machine, std::make_shared<machine::Motion>(quick()), Pose{}, rake, std::move(by));
  };
  EXPECT_THAT([&] { led(std::make_unique<ProgramOperator>(quick().value(0))).load(file); },
              ThrowsMessage<std::runtime_error>(
                  HasSubstr("drives of another kind: limited, with rules of the dig; this run's "
                            "are limited, led by a program")));
  EXPECT_THAT(
      [&] {
        Shovel(machine, quick(), Pose{}, rake, kLongestSubstep_ns, machine::DriveMode::limited)
            .load(file);
      },
      ThrowsMessage<std::runtime_error>(HasSubstr("this run's are limited, following the motion")));
}

INSTANTIATE_TEST_SUITE_P(Drives, ShovelState,
                         testing::Values(machine::DriveMode::prescribed,
                                         machine::DriveMode::limited),
                         [](const auto& mode) {
                           return mode.param == machine::DriveMode::limited ? "limited"
                                                                            : "prescribed";
                         });

}  // namespace
}  // namespace dipper::mbs
