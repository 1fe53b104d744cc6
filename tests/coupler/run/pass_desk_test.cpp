// What an operator who plans does between two passes: when the face is looked at, what is sent,
// when the run ends, what a checkpoint keeps of it, and the files that are left.
#include "coupler/run/pass_desk.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/angles.hpp"
#include "common/seconds.hpp"
#include "machine/motion_row.hpp"
#include "tests/coupler/case/checkout.hpp"
#include "tests/places.hpp"

namespace dipper::run {
namespace {

using nlohmann::json;
using testing::HasSubstr;
namespace fs = std::filesystem;

constexpr char kPlan[] = R"(source: "a test's"
sample_s: 0.25
cycle_s: 48
dig: [0.5, 18, 1.5]
swing_out: [13.5, 22, 2.5]
door_open: [22, 23.5, 0.6]
swing_back: [27, 36.5, 2.5]
back: [29.5, 43.5, 3]
door_close: [34.5, 37.5, 1]
lift_m: [[24.2, 11.4], [22.6, 14.3], [21.3, 15.2]]
lower_deg_m: [[8, 12.1], [-12, 11.5], [-30, 11.15], [-48, 11.1], [-60, 11.1]]
dump_deg: 80
door_deg: 75
choose:
  heading_deg: [0, 4, 4]
  depth_m: [0.8, 0.8, 0.1]
  floor_rise: [0.1, 0.1, 0.1]
  exit_z_m: [6, 6, 1]
  start_m: [13.1, 0.4]
  smooth_m: 3
  crowd_max_m: 2.95
  teeth_m_s: 1.2
)";

/// Keeps what it is sent to follow; the desk asks it nothing else.
struct TellingMachine final : core::Machine {
  core::ServerInfo info() const override {
    return {"machine", {}, {{"path_time", "s", "-"}, {"crowd_force", "N", "-"}}, 0};
  }
  core::MachineState state(std::int64_t) override { return {}; }
  core::MachineState step(const core::MachineStep&) override { return {}; }
  void save(const fs::path&) override {}
  void load(const fs::path&) override {}
  void follow(const std::string& rows) override { sent.push_back(rows); }
  std::vector<std::string> sent;
};

/// A bench of 35 degrees, as high as it is set to be.
struct SeenRock final : core::LocalRock {
  core::ServerInfo info() const override { return {"rock", {}, {{"mass_in_truck", "kg", "-"}}, 0}; }
  core::RockState place(const std::vector<Pose>&) override { return {}; }
  core::RockState step(const core::RockStep&) override { return {}; }
  void save(const fs::path&) override {}
  std::string state_hash() override { return ""; }
  HeightMap look(const HeightGrid& grid) override {
    ++looks;
    HeightMap map(grid);
    for (int i = 0; i < grid.nx; ++i)
      for (int j = 0; j < grid.ny; ++j)
        if (std::abs(map.y_of(j)) < 6)
          map.at(i, j) = std::clamp((map.x_of(i) - 13.5) * std::tan(radians(35)), 0.0, high_m);
    return map;
  }
  int looks = 0;
  double high_m = 8.5;
};

struct Said final : Reporter {
  void line(const std::string& text) override { lines.push_back(text); }
  void error(const std::string&) override {}
  void progress(const std::string&) override {}
  std::vector<std::string> lines;
};

class PassDeskTest : public testing::Test {
 protected:
  PassDeskTest() {
    test::write_text(checkout.folder() / "plan.yaml", kPlan);
    set("truck.rated_t", "200");
  }

  void set(const std::string& key, const std::string& value) { settings.push_back({key, value}); }

  PassDesk desk(const json& state = nullptr) {
    std::vector<Finding> findings;
    std::vector<cases::Override> all = {
        {"machine.operator", "plan"}, {"machine.plan", "plan.yaml"}, {"machine.drives", "limited"}};
    all.insert(all.end(), settings.begin(), settings.end());
    c = cases::load_case(checkout.folder(), all, findings);
    test::expect_findings(findings, {});
    return {c, {machine, rock, machine.info(), rock.info()}, folder(), state, said};
  }

  fs::path folder() const { return checkout.root / "operator"; }
  json read(const std::string& name) const { return json::parse(test::read_text(folder() / name)); }

  /// A window's end. \param path_s  of the motion, where the machine is on it
  static core::Window at(std::int64_t index, double path_s, double truck_t, double crowd_N = 0) {
    core::Window w;
    w.step_index = index;
    w.machine.channels = {path_s, crowd_N};
    w.rock.t_ns = std::llround(1.1e9 * path_s);  // late
    w.rock.channels = {1e3 * truck_t};
    return w;
  }

  /// Window by window through passes that load so much each; the last window passed to it.
  void go_through(PassDesk& desk, const std::vector<double>& truck_t) {
    desk.window(at(0, 0, truck_t[0]));
    for (std::size_t k = 1; k < truck_t.size() && !desk.finished(); ++k)
      desk.window(at(static_cast<std::int64_t>(k), desk.state().at("end_s"), truck_t[k]));
  }

  test::Checkout checkout;
  std::vector<cases::Override> settings;
  cases::Case c;
  TellingMachine machine;
  SeenRock rock;
  Said said;
};

TEST_F(PassDeskTest, LooksAtTheStartAndWhenAPassIsDone) {
  PassDesk one = desk();
  EXPECT_TRUE(one.needs_rest(at(0, 0, 0)));
  one.window(at(0, 0, 0));
  ASSERT_EQ(machine.sent.size(), 1U);
  const double end_s = one.state().at("end_s");
  EXPECT_FALSE(one.needs_rest(at(7, end_s - 0.01, 60))) << "by the motion's time, not the clock's";
  one.window(at(7, end_s - 0.01, 60));
  EXPECT_EQ(rock.looks, 1);
  EXPECT_TRUE(one.needs_rest(at(8, end_s + 0.01, 60)));
  one.window(at(8, end_s + 0.01, 60));
  ASSERT_EQ(machine.sent.size(), 2U);
  // What was sent is one motion, and what the files say of it.
  machine::Motion motion = machine::Motion::parse(machine::kMotionHead + machine.sent[0], "1");
  motion.extend(machine::Motion::parse(machine::kMotionHead + machine.sent[1], "2"));
  for (const int pass : {1, 2}) {
    const json file = read("pass_" + std::to_string(pass) + ".json");
    EXPECT_EQ(file.at("rows"), machine.sent[static_cast<std::size_t>(pass) - 1]);
    EXPECT_EQ(file.at("candidates").size(), 2U);
    EXPECT_EQ(file.at("goal"), "time") << "what their scores are";
    EXPECT_GT(file.at("dig_at_s"), file.at("begins_at_s"));
  }
  EXPECT_NEAR(seconds(motion.end_ns()), one.state().at("end_s").get<double>(), 1e-6);
}

TEST_F(PassDeskTest, StopsWhenOneMorePassWouldOverloadTheTruckByMoreThanItLacks) {
  PassDesk one = desk();
  go_through(one, {0, 70, 140, 164});  // 36 t are lacking, half a mean pass is 27 t
  EXPECT_FALSE(one.finished()) << read("pass_4.json").at("reason");
  PassDesk other = desk();
  go_through(other, {0, 70, 140, 176});  // 24 t are lacking, half a pass is 29 t
  EXPECT_TRUE(other.finished());
  EXPECT_THAT(read("end.json").at("reason").get<std::string>(), HasSubstr("the truck is full"));
  EXPECT_EQ(read("end.json").at("passes"), 3);
  EXPECT_TRUE(is_finished(other.state()));
  EXPECT_FALSE(other.needs_rest(at(9, 1e6, 176)));
}

TEST_F(PassDeskTest, StopsWhenNoPassPays) {
  rock.high_m = 0.8;
  PassDesk one = desk();
  go_through(one, {0, 0});
  EXPECT_TRUE(one.finished());
  EXPECT_TRUE(machine.sent.empty());
  EXPECT_THAT(read("end.json").at("reason").get<std::string>(), HasSubstr("no dig pays"));
  EXPECT_TRUE(read("pass_1.json").at("chosen").is_null()) << "the face as seen is kept";
  desk(one.state());
  EXPECT_TRUE(fs::exists(folder() / "pass_1.json")) << "and by a run that is resumed at its end";
}

TEST_F(PassDeskTest, ExpectsTheRunsEndByTheTruckAndThePassesAllowed) {
  set("operator.passes", "4");
  set("truck.rated_t", "0");
  PassDesk one = desk();
  EXPECT_EQ(one.expected_end_s(), 0) << "nothing is planned yet";
  go_through(one, {0, 60});
  const double two_s = one.state().at("end_s");
  EXPECT_EQ(one.passes(), 2);
  EXPECT_DOUBLE_EQ(one.expected_end_s(), 2 * two_s) << "four passes, as long as the first two";
  set("truck.rated_t", "125");
  PassDesk full = desk();
  go_through(full, {0, 60});
  EXPECT_DOUBLE_EQ(full.expected_end_s(), two_s) << "the second pass fills the truck";
}

TEST_F(PassDeskTest, StopsAfterSoManyPasses) {
  set("operator.passes", "2");
  PassDesk one = desk();
  go_through(one, {0, 10, 20, 30});
  EXPECT_TRUE(one.finished());
  EXPECT_EQ(machine.sent.size(), 2U);
  EXPECT_THAT(said.lines.back(), HasSubstr("all passes done (operator.passes: 2)"));
}

TEST_F(PassDeskTest, GoesOnFromACheckpointAsItWouldHaveWithoutAndForgetsWhatCameAfter) {
  PassDesk whole = desk();
  go_through(whole, {0, 60});
  const json kept = json::parse(whole.state().dump());  // as a checkpoint's file has it
  const double end_s = kept.at("end_s");
  for (int k = 2; k < 9 && !whole.finished(); ++k)
    whole.window(at(k, whole.state().at("end_s"), 70.0 * k));
  ASSERT_TRUE(whole.finished());
  const std::string third = machine.sent.at(2);
  ASSERT_TRUE(fs::exists(folder() / "pass_3.json") && fs::exists(folder() / "end.json"));
  test::write_text(folder() / "notes.txt", "mine");

  PassDesk resumed = desk(kept);
  EXPECT_EQ(resumed.state(), kept);
  EXPECT_TRUE(fs::exists(folder() / "pass_2.json"));
  EXPECT_FALSE(fs::exists(folder() / "pass_3.json")) << "of the future that is run anew";
  EXPECT_FALSE(fs::exists(folder() / "end.json"));
  EXPECT_TRUE(fs::exists(folder() / "notes.txt"));
  resumed.window(at(2, end_s, 140));
  EXPECT_EQ(machine.sent.back(), third);
}

TEST_F(PassDeskTest, LearnsFromAPassWhatTheNextNeeds) {
  PassDesk one = desk();
  one.window(at(0, 0, 0));
  const json first = one.state(), file = read("pass_1.json");
  EXPECT_EQ(file.at("resistance"), 1);
  const double from_s = first.at("rock_from_s"), to_s = first.at("rock_to_s"),
               expected_N = first.at("crowd_N");
  EXPECT_GT(from_s, file.at("dig_at_s").get<double>());
  EXPECT_LT(to_s, file.at("dump_at_s").get<double>());
  // 1.4 times the force that was expected, in rock; what is outside of it teaches nothing.
  int index = 1;
  for (double t = from_s - 1; t < to_s + 1; t += 0.05)
    one.window(at(index++, t, 0, t > from_s && t <= to_s ? 1.4 * expected_N : 9e6));
  one.window(at(index, first.at("end_s").get<double>() + 0.01, 50));
  EXPECT_NEAR(read("pass_2.json").at("resistance").get<double>(), std::sqrt(1.4), 0.03);
  EXPECT_NEAR(
      read("pass_2.json").at("loaded").get<double>(),
      file.at("loaded").get<double>() * std::sqrt(50e3 / first.at("payload_kg").get<double>()),
      1e-3);
}

TEST_F(PassDeskTest, LearnsTheLeastFromATruckThatLostRockAndACrowdThatHeldBack) {
  PassDesk one = desk();
  one.window(at(0, 0, 5));
  const json first = one.state();
  const double from_s = first.at("rock_from_s"), to_s = first.at("rock_to_s");
  int index = 1;
  for (double t = from_s; t < to_s; t += 0.05) one.window(at(index++, t, 5, -0.7e6));
  one.window(at(index, first.at("end_s").get<double>() + 0.01, 4.5));
  EXPECT_EQ(read("pass_2.json").at("loaded"), 0.6);
  EXPECT_EQ(read("pass_2.json").at("resistance"), 0.5);
  EXPECT_FALSE(one.finished());
}

TEST_F(PassDeskTest, AScannersErrorsAreThoseOfTheSeedAndThePass) {
  set("operator.scan_error_m", "0.05");
  go_through(*std::make_unique<PassDesk>(desk()), {0, 60});
  const json first = read("pass_1.json").at("face"), second = read("pass_2.json").at("face");
  EXPECT_NE(first, second) << "every pass has its own";
  go_through(*std::make_unique<PassDesk>(desk()), {0, 60});
  EXPECT_EQ(read("pass_1.json").at("face"), first);
  EXPECT_EQ(read("pass_2.json").at("face"), second);
}

}  // namespace
}  // namespace dipper::run
