// A program drives the real shovel against a wall, beside the same operator in this process.
#include "coupler/operate/operated_machine.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>

#include "common/temporary_folder.hpp"
#include "coupler/core/coupling.hpp"
#include "coupler/transport/link.hpp"
#include "mbs/path_follower.hpp"
#include "mbs/program_operator.hpp"
#include "tests/mbs/shovel_fixture.hpp"
#include "tests/mbs/wall_rock.hpp"

namespace dipper::operate {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr std::int64_t kSteps = 5;  // of the wall's, a window: 1.5 ms

/// The built-in operator, who looks as a program does and gives orders as a program's are given.
class BuiltIn final : public core::Machine {
 public:
  BuiltIn(mbs::Shovel& shovel, const std::shared_ptr<const machine::Motion>& motion,
          double crowd_min)
      : shovel_(shovel), follower_(motion, crowd_min) {}
  core::ServerInfo info() const override { return shovel_.info(); }
  core::MachineState state(std::int64_t t_next_ns) override {
    return now_ = shovel_.state(t_next_ns);
  }
  core::MachineState step(const core::MachineStep& step) override {
    core::MachineStep ordered = step;
    if (const std::int64_t look = now_.t_ns / kLook_ns; look != looked_) {
      looked_ = look;
      ordered.order = order((look + 1) * kLook_ns);
    }
    return now_ = shovel_.step(ordered);
  }
  void save(const fs::path&) override {}
  void load(const fs::path&) override {}

 private:
  core::Order order(std::int64_t by_ns) {
    const auto channel = [&](const char* name) {
      return now_.channels.at(core::channel_index(shovel_.info(), name));
    };
    follower_.ease(1e-9 * static_cast<double>(now_.t_ns), [&] {
      return mbs::Overload{channel("crowd_overload"),
                           std::max(channel("hoist_overload"), channel("swing_overload"))};
    });
    const machine::DriveState s = follower_.setpoint(1e-9 * static_cast<double>(by_ns));
    return {by_ns,
            {s.position.hoist, s.position.crowd, s.position.swing, s.position.door, s.rate.hoist,
             s.rate.crowd, s.rate.swing, s.rate.door}};
  }

  mbs::Shovel& shovel_;
  mbs::PathFollower follower_;
  core::MachineState now_;
  std::int64_t looked_ = -1;
};

class OperatedMachineTest : public mbs::ShovelTest {
 protected:
  void SetUp() override {
    std::signal(SIGPIPE, SIG_IGN);
    setenv("PYTHONPATH", (source() / "analysis/runs").c_str(), 1);
    setenv("PYTHONDONTWRITEBYTECODE", "1", 1);
    std::ofstream(motion_file) << "time_s,hoist_m,crowd_m,swing_deg,door_deg\n" << kRows;
  }

  mbs::Shovel shovel() const {
    return {machine, motion_, Pose{}, rake,
            std::make_unique<mbs::ProgramOperator>(motion_->value(0))};
  }
  mbs::WallRock wall(mbs::Shovel& shovel) const {
    const Vector3d teeth_B(machine.dipper.inside.x() + machine.dipper.tooth_reach, 0,
                           -machine.dipper.inside.z() / 2);
    return {teeth_B, shovel.state(0).bodies[0].X_WB * teeth_B + Vector3d(0.3, 0, 0),
            Vector3d(-1, 0, 0), 3e7};
  }
  Operated setup(const std::string& command) const {
    Operated o;
    o.case_name = "wall";
    o.motion = motion_file;
    o.machine = machine;
    o.rake = rake;
    o.program = {command, folder.path(), false};
    o.patience = std::chrono::seconds(30);
    o.log = folder.path() / "operator.log";
    return o;
  }
  std::string python(const std::string& file) const {
    return "/usr/bin/python3 " + (source() / "tests/coupler/operate" / file).string();
  }
  /// A shell script as the program.
  std::string shell(const std::string& text) const {
    const fs::path file = folder.path() / "program.sh";
    std::ofstream(file) << text;
    return "sh " + file.string();
  }
  /// What the run says of a program that does something wrong.
  std::string fault(const std::string& command, std::chrono::milliseconds patience) {
    mbs::Shovel machine_ = shovel();
    Operated o = setup(command);
    o.patience = patience;
    try {
      OperatedMachine operated(machine_, o, false, {});
      operated.state(0);
      for (int i = 1; i <= 200; ++i) operated.step({i * 1'500'000, no_rock});
    } catch (const transport::PeerError& e) {
      EXPECT_EQ(e.side, "operator");
      EXPECT_THAT(e.what(), HasSubstr("`" + command + "`"));
      return e.what();
    }
    return "";
  }

  static constexpr const char* kRows = "0,-4,-0.5,0,0\n1,-4,-0.5,0,0\n4,-4,1,0,0\n7,-6,1,10,20\n";
  const TemporaryFolder folder{"operated"};
  const fs::path motion_file = folder.path() / "motion.csv";
  std::shared_ptr<machine::Motion> motion_ = std::make_shared<machine::Motion>(motion(kRows));
};

std::vector<core::MachineState> windows(core::Coupling& coupling, int n) {
  std::vector<core::MachineState> all;
  for (int i = 0; i < n; ++i) {
    coupling.begin(kSteps);
    all.push_back(coupling.finish(kSteps).machine);
  }
  return all;
}

void expect_same(const std::vector<core::MachineState>& a,
                 const std::vector<core::MachineState>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].channels, b[i].channels) << i;
    for (std::size_t body = 0; body < 2; ++body) {
      ASSERT_EQ(a[i].bodies[body].X_WB.p, b[i].bodies[body].X_WB.p) << i;
      ASSERT_EQ(a[i].bodies[body].X_WB.R.coeffs(), b[i].bodies[body].X_WB.R.coeffs()) << i;
    }
  }
}

constexpr int kWindows = 2000;  // 3 s, of which the crowd stalls for one

// The built-in operator as a program in another language: nothing is lost between, to the last bit.
TEST_F(OperatedMachineTest, TheBuiltInOperatorAsAProgramIsTheSameRun) {
  mbs::Shovel a = shovel(), b = shovel();
  mbs::WallRock wall_a = wall(a), wall_b = wall(b);
  BuiltIn here(a, motion_, machine.limits.crowd_min);
  OperatedMachine there(b, setup(python("path_follower.py")), false, {});
  core::Coupling one(here, wall_a, core::Scheme::corrected),
      two(there, wall_b, core::Scheme::corrected);
  one.start();
  two.start();
  const auto mine = windows(one, kWindows), its = windows(two, kWindows);
  expect_same(mine, its);
  const std::size_t stalled = core::channel_index(a.info(), "crowd_saturated");
  const auto times = std::count_if(mine.begin(), mine.end(),
                                   [&](const auto& s) { return s.channels[stalled] == 1; });
  EXPECT_GT(times, 200) << "it had nothing to decide";
  EXPECT_FALSE(there.done());
  there.end();
}

// A checkpoint in the middle of a look, with the crowd stalled.
TEST_F(OperatedMachineTest, ARunThatGoesOnIsTheSameRun) {
  const fs::path saved = folder.path() / "machine.state";
  mbs::Shovel a = shovel();
  mbs::WallRock wall_a = wall(a);
  std::vector<core::MachineState> after;
  core::CouplingState state;
  std::vector<Pose> X_WB;
  {
    OperatedMachine first(a, setup(python("path_follower.py")), false, {});
    core::Coupling coupling(first, wall_a, core::Scheme::corrected);
    coupling.start();
    windows(coupling, 1430);
    first.save(saved);
    state = coupling.state();
    after = windows(coupling, 400);
  }
  for (const core::WallState& w : state.walls) X_WB.push_back(w.X_WB);
  mbs::Shovel b = shovel();
  mbs::WallRock wall_b = wall(b);
  OperatedMachine second(b, setup(python("path_follower.py")), true, {});
  second.load(saved);
  wall_b.place(X_WB);
  core::Coupling coupling(second, wall_b, core::Scheme::corrected);
  coupling.resume(state);
  expect_same(after, windows(coupling, 400));
}

TEST_F(OperatedMachineTest, NamesWhatAProgramDoesWrong) {
  const std::string greets = "read line; echo '{\"dipper_operator\": 1}'; read line; ";
  const std::chrono::seconds patience(20);
  EXPECT_THAT(fault(shell("echo woe >&2; exit 7"), patience), HasSubstr("woe (exit status 7)"));
  EXPECT_THAT(fault(shell(greets + "exit 0"), patience), HasSubstr("exit status 0"));
  EXPECT_THAT(fault(shell(greets + "kill -9 $$"), patience), HasSubstr("killed by signal 9"));
  EXPECT_THAT(fault(shell("read line; echo hello; sleep 60"), patience),
              HasSubstr("not a line of JSON: 'hello'"));
  EXPECT_THAT(fault(shell("read line; echo '{\"dipper_operator\": 2}'; sleep 60"), patience),
              HasSubstr("{\"dipper_operator\": 1}, and is"));
  EXPECT_THAT(fault(shell(greets + "echo '{\"hoist_m\": NaN}'; sleep 60"), patience),
              HasSubstr("not a line of JSON"));
  EXPECT_THAT(fault(shell(greets + "sleep 60"), std::chrono::milliseconds(300)),
              HasSubstr("no answer for 0.3 s"));
}

TEST_F(OperatedMachineTest, ACheckpointOfAnotherOperatorIsRefused) {
  mbs::Shovel a = shovel();
  const fs::path saved = folder.path() / "machine.state";
  a.save(saved);
  OperatedMachine operated(a, setup("cat"), true, {});
  try {
    operated.load(saved);
    FAIL();
  } catch (const std::exception& e) {
    EXPECT_THAT(e.what(), HasSubstr("a program did not drive this run so far"));
  }
}

}  // namespace
}  // namespace dipper::operate
