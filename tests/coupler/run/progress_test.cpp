#include "coupler/run/progress.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <functional>

#include "common/seconds.hpp"
#include "tests/places.hpp"

namespace dipper::run {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;

const std::filesystem::path kSource = test::source();

struct Lines final : Reporter {
  void line(const std::string&) override {}
  void error(const std::string&) override {}
  void progress(const std::string& text) override { last = text; }
  std::string last;
};

core::ServerInfo info(const std::string& channel) {
  core::ServerInfo i;
  i.channels = {{channel, "kg", "-"}};
  return i;
}

TEST(MotionPhases, ArePassByPassThoseOfTheMotion) {
  const auto motion = machine::Motion::load(kSource / "cases" / "aitik" / "motion.csv");
  const MotionPhases phases(motion);
  EXPECT_EQ(phases.at(-1), "");
  EXPECT_EQ(phases.at(0), "1 approach");
  EXPECT_EQ(phases.at(27), "1 dump");
  EXPECT_EQ(phases.at(35), "1 return");
  EXPECT_EQ(phases.at(48 + 8), "2 fill");
  EXPECT_EQ(phases.at(seconds(motion.end_ns())), "3 return")
      << "the return belongs to the last pass";
  EXPECT_EQ(phases.at(1e4), "3 return");
}

TEST(MotionPhases, AMotionThatDumpsNothingIsOnePass) {
  const MotionPhases phases(machine::Motion::parse(
      "time_s,hoist_m,crowd_m,swing_deg,door_deg\n0,0,0,0,0\n5,0,1,0,0\n10,0,2,0,0\n", "m"));
  EXPECT_EQ(phases.at(5), "1 fill");
}

class ProgressTest : public testing::Test {
 protected:
  ProgressTest() { c_.machine.motion = kSource / "cases" / "aitik" / "motion.csv"; }

  core::Window window(double t_s) const {
    core::Window w;
    w.step_index = 1;
    w.rock.t_ns = std::llround(t_s * 1e9);
    w.rock.channels = {81900};
    w.machine.channels = {9};
    return w;
  }
  Lines lines_;
  cases::Case c_;
  RunEnd end_{1107693, std::nullopt};
  Progress::Clock::time_point now_{};
  std::function<Progress::Clock::time_point()> clock_ = [this] { return now_; };
};

TEST_F(ProgressTest, ShowsPhasePayloadTimeLeftAndSpeedInTheWidthOfATerminal) {
  c_.dem.timestep_s = 1.3e-4;
  Progress progress(lines_, c_, end_, info("energy"), info("mass_in_dipper"), clock_);
  progress.window(window(1.2));
  now_ += std::chrono::hours(1);
  progress.window(window(101.2));
  EXPECT_EQ(lines_.last,
            "[####..] 101.2/144.0 s  3 penetrate  payload 81.9 t  26 min left  speed 0.0278");
  EXPECT_LE(lines_.last.size(), 79U);
}

TEST_F(ProgressTest, LimitedDrivesAreWhereTheirPathIs) {
  c_.dem.timestep_s = 1.3e-4;
  c_.machine.drives = machine::DriveMode::limited;
  end_.path_s = 144;
  Progress progress(lines_, c_, end_, info("path_time"), info("mass_in_dipper"));
  progress.window(window(107.7));
  EXPECT_THAT(lines_.last, AllOf(HasSubstr("] 107.7 s  1 "), Not(HasSubstr("/144"))))
      << "no end: the drives take as long as they need";
}

TEST_F(ProgressTest, AnOperatorsRunLastsAsLongAsItsPasses) {
  c_.dem.timestep_s = 1.3e-4;
  c_.machine.drives = machine::DriveMode::limited;
  c_.machine.operated_by = cases::OperatorKind::plan;
  Progress progress(lines_, c_, {4 * end_.step, std::nullopt}, info("path_time"),
                    info("mass_in_dipper"), clock_);
  progress.follow([] { return Progress::Passes{2, 90}; });
  core::Window w = window(3);
  progress.window(w);
  now_ += std::chrono::minutes(1);
  w = window(41);
  w.machine.channels = {39};  // on the motion; 2 s late
  progress.window(w);
  EXPECT_THAT(lines_.last, HasSubstr("[##....] 41.0 s  pass 2  payload 81.9 t  2 min left"));
}

TEST_F(ProgressTest, ShowsNoTimeLeftBeforeItIsKnownWell) {
  c_.dem.timestep_s = 1.3e-4;
  Progress progress(lines_, c_, end_, info("energy"), info("mass_in_dipper"), clock_);
  now_ += std::chrono::hours(1);  // the start-up does not count
  progress.window(window(0.1));
  EXPECT_THAT(lines_.last, Not(HasSubstr("left")));
  now_ += std::chrono::seconds(9);
  progress.window(window(14.1));
  EXPECT_THAT(lines_.last, Not(HasSubstr("left"))) << "too short a time";
  now_ += std::chrono::seconds(1);
  progress.window(window(2.1));
  EXPECT_THAT(lines_.last, Not(HasSubstr("left"))) << "too short a way";
  progress.window(window(14.5));
  EXPECT_THAT(lines_.last, HasSubstr("90 s left"));
}

}  // namespace
}  // namespace dipper::run
