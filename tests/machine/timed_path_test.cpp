#include "machine/timed_path.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "common/angles.hpp"
#include "common/input_error.hpp"
#include "machine/motion_row.hpp"
#include "tests/places.hpp"

namespace dipper::machine {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

const std::filesystem::path kSource = test::source();

class TimedPathTest : public testing::Test {
 protected:
  static TimedPath read(const std::string& rows) {
    const auto file = std::filesystem::path(testing::TempDir()) / "timed_path_test.csv";
    std::ofstream(file) << "x_m,z_m,speed_m_s,wait_s,swing_deg,door_deg\n" << rows;
    return read_timed_path(file);
  }
  Motion motion(const TimedPath& path) const {
    return Motion::parse(kMotionHead + motion_rows(path, kinematics_), "path");
  }
  Vector2d teeth(const Motion& motion, double t_s) const {
    return kinematics_.teeth(motion.at(t_s).position);
  }

  MachineData data_ = load_machine(kSource / "mbs" / "bucyrus495.yaml");
  ShovelKinematics kinematics_{data_, Pose{}, radians(61.8)};
};

TEST_F(TimedPathTest, IsThereWhenItsSpeedsSay) {
  // 4 m from rest to 1 m/s, 3 m at 1 m/s, 4 m back to rest, all in line.
  const TimedPath path = read("14,1,0,0,0,0\n18,1,1,0,0,0\n21,1,1,0,0,0\n25,1,0,0,0,0\n");
  ASSERT_EQ(path.points.size(), 4U);
  EXPECT_NEAR(path.points[1].t_s, 8, 1e-9);
  EXPECT_NEAR(path.points[2].t_s, 11, 1e-9);
  EXPECT_NEAR(path.points[3].t_s, 19, 1e-9);
  const Motion m = motion(path);
  EXPECT_NEAR(teeth(m, 4).x(), 15, 2e-3) << "constant acceleration: a quarter of the way";
  EXPECT_NEAR(teeth(m, 8).x(), 18, 2e-3);
  EXPECT_NEAR((teeth(m, 9.6) - teeth(m, 9.4)).norm() / 0.2, 1, 5e-3);
  EXPECT_NEAR(teeth(m, 19).x(), 25, 1e-3);
}

TEST_F(TimedPathTest, GoesThroughEveryPointWithoutACornerAndStopsWhereAsked) {
  const TimedPath path = read(
      "13.1,0.45,0,0,5,0\n18.5,2.2,0.9,0,5,0\n23.8,7,0.9,0,5,0\n22.4,14,0,0,60,0\n"
      "22.4,14,0,2,80,0\n22.4,14,0,1.5,80,75\n");
  const Motion m = motion(path);
  for (const PathPoint& p : path.points) {
    EXPECT_LT((teeth(m, p.t_s) - p.tip).norm(), 0.01) << p.tip.transpose();
    EXPECT_NEAR(m.at(p.t_s).position.swing, p.swing_rad, radians(0.5));
  }
  EXPECT_NEAR(path.points[4].t_s - path.points[3].t_s, 2, 1e-9);
  EXPECT_NEAR(degrees(m.at(path.points.back().t_s + 1).position.door), 75, 1e-4);
  const double at = path.points[1].t_s;
  const Vector2d in = teeth(m, at - 0.2) - teeth(m, at - 0.6);
  const Vector2d out = teeth(m, at + 0.6) - teeth(m, at + 0.2);
  EXPECT_GT(in.normalized().dot(out.normalized()), 0.995);
}

TEST_F(TimedPathTest, EveryFaultIsNamedWithItsLine) {
  const auto expect = [](const std::string& rows, const std::string& message) {
    EXPECT_THAT([&] { read(rows); }, ThrowsMessage<InputError>(HasSubstr(message))) << rows;
  };
  expect("13,1,0,0,0,0\n", "a path needs 2");
  expect("13,1,0,0,0,0\n15,1,0,0,0,0\n", ":3:1: speed_m_s is 0 here and in the previous row");
  expect("13,1,0,0,0,0\n15,1,-1,0,0,0\n17,1,0,0,0,0\n", ":3:1: speed_m_s is -1");
  expect("13,1,1,0,0,0\n15,1,0,0,0,0\n", ":2:1: speed_m_s is 1; a motion begins and ends at rest");
  expect("13,1,0,0,0,0\n15,1,1,2,0,0\n17,1,0,0,0,0\n", ":3:1: wait_s is 2, but the teeth move");
  expect("13,1,0,0,0,0\n13,1,0,0,9,0\n",
         ":3:1: repeats the point; write the waiting time in wait_s");
  expect("13,1,0,0,0,0\n15,1,1,0,0,0\n15,1,0,3,0,0\n", ":4:1: repeats the point; speed_m_s");
  const TimedPath near = read("13,1,0,0,0,0\n9.2,10.8,1,0,0,0\n13,1,0,0,0,0\n");
  EXPECT_THROW(motion_rows(near, kinematics_), std::domain_error);
}

}  // namespace
}  // namespace dipper::machine
