// A run is never resumed from a checkpoint that has changed since it was written.
#include "coupler/run/checkpoint.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <iterator>

#include "tests/common/input_errors.hpp"

namespace dipper::run {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

/// Sides that save a text.
class TextRock final : public core::LocalRock {
 public:
  core::ServerInfo info() const override { return {}; }
  core::RockState place(const std::vector<Pose>&) override { return {}; }
  core::RockState step(const core::RockStep&) override { return {}; }
  void save(const fs::path& file) override { std::ofstream(file) << "where the rock is"; }
  std::string state_hash() override { return ""; }
};

class TextMachine final : public core::Machine {
 public:
  core::ServerInfo info() const override { return {}; }
  core::MachineState state(std::int64_t) override { return {}; }
  core::MachineState step(const core::MachineStep&) override { return {}; }
  void save(const fs::path& file) override { std::ofstream(file) << "where the machine is"; }
  void load(const fs::path&) override {}
};

class Checkpoints : public testing::Test {
 protected:
  Checkpoints() {
    fs::remove_all(folder_);
    for (const std::int64_t step : {10, 20}) {
      Checkpoint c;
      c.coupling.step_index = step;
      c.coupling.walls = {{Pose{Quaterniond(0.6, 0, 0.8, 0), {1, 2, 3}},
                           Twist{{7, 8, 9}, {10, 11, 12}}, Wrench{{1, 2, 3}, {4, 5, 6}}}};
      c.record.t_ns = step * 1000;
      c.cost.wall_s = 1.5;
      c.cost.resends = 3;
      save_checkpoint(folder_, c, rock_, machine_);
    }
  }
  ~Checkpoints() override { fs::remove_all(folder_); }

  /// The step gone on from, and what was said.
  std::pair<std::int64_t, std::string> last() {
    testing::internal::CaptureStderr();
    const auto c = last_checkpoint(folder_);
    return {c ? c->coupling.step_index : -1, testing::internal::GetCapturedStderr()};
  }

  const fs::path folder_ =
      fs::path(testing::TempDir()) / ("checkpoints" + std::to_string(getpid()));
  const fs::path newest_ = folder_ / "000000020";
  TextRock rock_;
  TextMachine machine_;
};

TEST_F(Checkpoints, TheNewestIsTaken) {
  const auto c = last_checkpoint(folder_);
  ASSERT_TRUE(c);
  EXPECT_EQ(c->coupling.step_index, 20);
  EXPECT_EQ(c->coupling.walls.at(0).X_WB.R.y(), 0.8);
  EXPECT_EQ(c->coupling.walls.at(0).V_WB_W.v.z(), 12);
  EXPECT_EQ(c->coupling.walls.at(0).load.force.z(), 6);
  EXPECT_EQ(c->record.t_ns, 20'000);
  EXPECT_EQ(c->cost.wall_s, 1.5);
  EXPECT_EQ(c->cost.resends, 3);
  EXPECT_EQ(last().second, "");
}

TEST_F(Checkpoints, AUsersFoldersAreNone) {
  fs::copy(newest_, folder_ / "keep");
  for (const char* name : {"zz", ".snapshot", "lost+found"}) fs::create_directory(folder_ / name);
  EXPECT_EQ(last(), std::make_pair(std::int64_t{20}, std::string()));
  Checkpoint c;
  c.coupling.step_index = 30;
  save_checkpoint(folder_, c, rock_, machine_);
  EXPECT_TRUE(fs::exists(folder_ / "keep") && fs::exists(folder_ / "zz"));
  EXPECT_FALSE(fs::exists(folder_ / "000000010"));
}

TEST_F(Checkpoints, AFlippedBitMakesItTheOneBefore) {
  for (const char* name : {"machine.state", "rock.restart", "coupling.json"}) {
    const fs::path file = newest_ / name;
    std::ifstream in(file, std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(in), {}};
    bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
    std::ofstream(file, std::ios::binary) << bytes;
    const auto [step, said] = last();
    EXPECT_EQ(step, 10);
    EXPECT_THAT(said, AllOf(HasSubstr(file.string() + " has changed since it was written"),
                            HasSubstr("000000020.damaged"), HasSubstr("000000010")));
    Checkpoint c;
    c.coupling.step_index = 20;
    save_checkpoint(folder_, c, rock_, machine_);
    EXPECT_EQ(last().first, 20);
  }
}

TEST_F(Checkpoints, AFileCutShortOrGoneMakesItTheOneBefore) {
  fs::resize_file(newest_ / "rock.restart", 5);
  EXPECT_EQ(last().first, 10);
}

TEST_F(Checkpoints, NoneLeftIsAnErrorThatNamesThemAll) {
  const fs::path older = folder_ / "000000010";
  fs::resize_file(newest_ / "rock.restart", 5);
  fs::remove(older / "coupling.json");
  const auto both =
      AllOf(HasSubstr((newest_ / "rock.restart").string() + " has changed since it was written"),
            HasSubstr((older / "coupling.json").string() + " is missing"),
            HasSubstr("no valid checkpoint is left"), HasSubstr("another --out"));
  EXPECT_THAT(test::message_of([&] { last_checkpoint(folder_); }), both);
  EXPECT_TRUE(fs::exists(newest_) && fs::exists(older));  // all is left where it is
  EXPECT_THAT(test::message_of([&] { last_checkpoint(folder_); }), both);
}

TEST_F(Checkpoints, NoneLeftIsAnErrorWhenTheyWereSetAsideBefore) {
  fs::resize_file(newest_ / "rock.restart", 5);
  EXPECT_EQ(last().first, 10);
  fs::remove_all(folder_ / "000000010");
  EXPECT_THAT(test::message_of([&] { last_checkpoint(folder_); }),
              AllOf(HasSubstr("000000020.damaged: set aside as damaged: "),
                    HasSubstr("rock.restart has changed since it was written")));
}

TEST_F(Checkpoints, ThatThereNeverWasOneIsNoError) {
  fs::remove_all(folder_);
  EXPECT_EQ(last().first, -1);
  fs::create_directories(folder_ / "000000010.part");  // killed while it saved its first
  EXPECT_EQ(last().first, -1);
}

}  // namespace
}  // namespace dipper::run
