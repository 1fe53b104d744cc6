#include "machine/motion_plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "common/angles.hpp"
#include "common/input_error.hpp"
#include "machine/motion_plan_file.hpp"
#include "machine/motion_row.hpp"
#include "tests/places.hpp"

namespace dipper::machine {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

const std::filesystem::path kSource = test::source();

struct Shovel {
  MachineData data = load_machine(kSource / "mbs" / "bucyrus495.yaml");
  ShovelKinematics kinematics{data, Pose{}, radians(61.8)};
};

TEST(Move, IsSmoothAndEndsWhereItShould) {
  const Move m{2, 12, 3};
  EXPECT_EQ(m.share(0), 0);
  EXPECT_NEAR(m.share(7), 0.5, 1e-12);
  EXPECT_NEAR(m.share(20), 1, 1e-12);
  const auto speed = [&](double t) { return (m.share(t + 1e-5) - m.share(t - 1e-5)) / 2e-5; };
  EXPECT_NEAR(speed(7), 1.0 / 7, 1e-6) << "constant between the ramps: way 1 in 10 - 3 s";
  EXPECT_NEAR(speed(3.5), 0.5 / 7, 1e-6) << "half of it half way up the ramp";
  EXPECT_NEAR(speed(2.01), 0, 1e-4);
  const Move hard{0, 1, 0};
  EXPECT_NEAR(hard.share(0.25), 0.25, 1e-12);
}

TEST(MotionPlan, TheTeethGoWhereTheyAreSent) {
  const Shovel shovel;
  for (const Vector2d& tip : {Vector2d(13.1, 0.4), Vector2d(20, 3.5), Vector2d(23, 12)}) {
    const Drives d = shovel.kinematics.teeth_at(tip);
    const ShovelPose X = shovel.kinematics.pose(d);
    const Vector3d inside = shovel.data.dipper.inside;
    const Vector3d teeth =
        X.X_WB * Vector3d(inside.x() + shovel.data.dipper.tooth_reach, 0, -inside.z() / 2);
    EXPECT_NEAR(teeth.x(), tip.x(), 1e-9);
    EXPECT_NEAR(teeth.z(), tip.y(), 1e-9);
    const Vector3d heel = X.X_WB * Vector3d(0, 0, -inside.z() / 2);
    EXPECT_LT((shovel.kinematics.heel(tip) - Vector2d(heel.x(), heel.z())).norm(), 1e-9);
    const Vector3d saddle = shovel.data.saddle.position;
    EXPECT_NEAR(shovel.kinematics.teeth_reach(d.crowd),
                (tip - Vector2d(saddle.x(), saddle.z())).norm(), 1e-9);
  }
  EXPECT_THROW(shovel.kinematics.teeth_at({9.2, 10.8}), std::domain_error);
}

TEST(MotionRow, TimesAreToTheMicrosecond) {
  const Shovel shovel;
  const auto time = [&](double t_s) {
    const std::string row = motion_row(t_s, {13.1, 0.4}, 0, 0, shovel.kinematics);
    return row.substr(0, row.find(','));
  };
  EXPECT_EQ(time(0), "0.00");
  EXPECT_EQ(time(12.3), "12.30");
  EXPECT_EQ(time(1000.025), "1000.025");
  EXPECT_EQ(time(0.0333333333), "0.033333");
}

class PlanFileTest : public testing::Test {
 protected:
  PlanFile read(const std::string& text) const {
    const auto file = std::filesystem::path(testing::TempDir()) / "motion_plan_test.yaml";
    std::ofstream(file) << text;
    return read_plan(file, shovel_.data, shovel_.kinematics, [](const std::string& name, double) {
      if (name != "pile") throw InputError({{name, 3, "", "is not a face"}});
      return TeethPath{{0, 0}, {13.5, 0}, {30, 11.5}, {40, 11.5}};
    });
  }
  Shovel shovel_;
  std::string text_ =
      "source: a test\n"
      "sample_s: 0.5\n"
      "cycle_s: 40\n"
      "dig: [1, 20, 2]\n"
      "swing_out: [15, 24, 2]\n"
      "door_open: [24, 25, 0.3]\n"
      "back: [28, 39, 2]\n"
      "swing_back: [26, 36, 2]\n"
      "door_close: [33, 35, 0.5]\n"
      "lift_m: [[24, 11.5], [21.3, 15.2]]\n"
      "lower_deg_m: [[8, 12.1], [-12, 11.5], [-30, 11.35], [-48, 11.35], [-60, 11.3]]\n"
      "dump_deg: 80\n"
      "door_deg: 70\n"
      "passes:\n"
      "  - heading_deg: 10\n"
      "    cut: {face: pile, start_m: [13.1, 0.4], depth_m: 1, floor_rise: 0.05, exit_z_m: 8, "
      "smooth_m: 2, crowd_max_m: 2.9}\n"
      "  - heading_deg: -10\n"
      "    path_m: [[13.2, 0.4], [18, 2], [23, 6], [24, 9]]\n";
};

TEST_F(PlanFileTest, MakesAMotionThatTheMachineCanDo) {
  const PlanFile plan = read(text_);
  EXPECT_EQ(plan.source, "a test");
  const Motion motion = Motion::parse(
      "time_s,hoist_m,crowd_m,swing_deg,door_deg\n" + motion_rows(plan.plan, shovel_.kinematics),
      "plan");
  EXPECT_THAT(shovel_.kinematics.check(motion), testing::IsEmpty());
  const auto at = [&](double t_s) { return motion.at(t_s).position; };
  EXPECT_NEAR(degrees(at(0).swing), 10, 1e-4);
  EXPECT_NEAR(degrees(at(25).swing), 80, 1e-4);
  EXPECT_NEAR(degrees(at(26).door), 70, 1e-4);
  EXPECT_NEAR(degrees(at(40).swing), -10, 1e-4);
  EXPECT_NEAR(degrees(at(40).door), 0, 1e-4);
  EXPECT_NEAR(degrees(at(80).swing), 10, 1e-4) << "back to the first dig";
  EXPECT_NEAR(at(80).crowd, at(0).crowd, 1e-3);
}

TEST_F(PlanFileTest, EndsWithTheDumpWhenNothingBringsItBack) {
  std::string once = text_;
  for (const char* key : {"back:", "swing_back:", "door_close:", "lower_deg_m:"}) {
    const auto at = once.find(key);
    once.erase(at, once.find('\n', at) - at + 1);
  }
  once.erase(once.find("  - heading_deg: -10"));
  const Motion motion = Motion::parse("time_s,hoist_m,crowd_m,swing_deg,door_deg\n" +
                                          motion_rows(read(once).plan, shovel_.kinematics),
                                      "plan");
  EXPECT_NEAR(degrees(motion.at(40).position.door), 70, 1e-4);
  EXPECT_NEAR(degrees(motion.at(40).position.swing), 80, 1e-4);
}

TEST_F(PlanFileTest, ARangeHasBothEndsAlsoWhereTheStepDoesNotDivideIt) {
  std::string text = text_.substr(0, text_.find("passes:"));
  text +=
      "choose:\n  heading_deg: [0, 0, 1]\n  depth_m: [0.9, 1.5, 0.2]\n  floor_rise: [0.1, 0.3, "
      "0.15]\n  exit_z_m: [6, 6, 1]\n  start_m: [13.1, 0.4]\n  smooth_m: 3\n  crowd_max_m: 2.9\n"
      "  teeth_m_s: 1.2\n";
  const DigChoice choice = read(text).choice.value();
  using testing::DoubleNear;
  EXPECT_THAT(choice.depth_m,
              testing::ElementsAre(0.9, DoubleNear(1.1, 1e-12), DoubleNear(1.3, 1e-12), 1.5));
  EXPECT_THAT(choice.floor_rise, testing::ElementsAre(0.1, 0.25, 0.3));
  EXPECT_THAT(choice.heading_rad, testing::ElementsAre(0));
}

TEST_F(PlanFileTest, EveryFaultIsNamed) {
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = text_;
    return text.replace(text.find(from), from.size(), to);
  };
  const auto expect = [&](const std::string& text, const std::string& message) {
    EXPECT_THAT([&] { read(text); }, ThrowsMessage<InputError>(HasSubstr(message)));
  };
  expect(with("dig: [1, 20, 2]", "dig: [20, 1, 2]"), ":4: dig: must begin before it ends");
  expect(with("cycle_s: 40\n", ""), "cycle_s: missing key");
  expect(with("back: [28, 39, 2]\n", ""), "back: missing key");
  expect(with("depth_m: 1,", "depth_m: -1,"), "passes.0.cut.depth_m: -1 is out of range");
  expect(with("face: pile", "face: wall.csv"), "passes.0.cut.face: wall.csv:3: is not a face");
  expect(with("lift_m: [[24, 11.5]", "lift_m: [[24]"), "lift_m.0: is a list; write [x, z] in m");
  expect(with("door_deg: 70\n", "door_deg: 70\ncolour: red\n"), "colour: unknown key");
  const PlanFile far = read(with("[23, 6], [24, 9]]", "[23, 6], [9.2, 10.8]]"));
  MotionPlan plan = far.plan;
  plan.lift = {{9.2, 10.8}, {9.2, 10.8}};
  EXPECT_THROW(motion_rows(plan, shovel_.kinematics), std::domain_error);
}

}  // namespace
}  // namespace dipper::machine
