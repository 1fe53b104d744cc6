#include "machine/kinematics.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "machine/sheave_path.hpp"
#include "tests/places.hpp"

namespace dipper::machine {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::filesystem::path kSource = test::source();

class Kinematics : public testing::Test {
 protected:
  const MachineData machine = load_machine(kSource / "mbs/bucyrus495.yaml");
  const ShovelKinematics shovel{machine, Pose{}, machine.dipper.base_rake};

  Motion motion(const std::string& rows) {
    return Motion::parse("time_s,hoist_m,crowd_m,swing_deg,door_deg\n" + rows, "m.csv");
  }
};

// A quarter turn: two straights of length 3 and an arc of pi/2, by hand.
TEST(SheavePath, QuarterTurnByHand) {
  const SheavePath p = sheave_path({-3, 1}, {1, -3}, 1);
  EXPECT_NEAR(p.length, 6 + M_PI / 2, 1e-12);
  EXPECT_NEAR(p.free_b, 3, 1e-12);
  EXPECT_NEAR(p.wrap, M_PI / 2, 1e-12);
  EXPECT_NEAR((p.toward_a - Vector2d(1, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((p.toward_b - Vector2d(0, 1)).norm(), 0, 1e-12);
}

// Moving an end lengthens the path by what it moves against the rope (the tangent points drop out).
TEST(SheavePath, LengthChangesAlongTheRope) {
  const Vector2d a(-12, -8), b(2.5, -9);
  constexpr double h = 1e-6;
  const SheavePath p = sheave_path(a, b, 1.2);
  for (const Vector2d& d : {Vector2d(1, 0), Vector2d(0, 1), Vector2d(0.6, -0.8)}) {
    const double at_b =
        (sheave_path(a, b + h * d, 1.2).length - sheave_path(a, b - h * d, 1.2).length);
    const double at_a =
        (sheave_path(a + h * d, b, 1.2).length - sheave_path(a - h * d, b, 1.2).length);
    EXPECT_NEAR(at_b / (2 * h), -p.toward_b.dot(d), 1e-8);
    EXPECT_NEAR(at_a / (2 * h), -p.toward_a.dot(d), 1e-8);
  }
}

TEST(SheavePath, RefusesAnEndInsideTheSheave) {
  EXPECT_THROW(sheave_path({-3, 1}, {0.5, -0.5}, 1), std::domain_error);
}

TEST_F(Kinematics, SaddleAngleInvertsTheRopePath) {
  for (double saddle : {-1.3, -0.8, -0.2, 0.1}) {
    for (double crowd : {-1.5, 0.0, 3.0}) {
      const double hoist = shovel.rope_path(saddle, crowd) - machine.rope.length_at_zero_hoist;
      EXPECT_NEAR(shovel.saddle_angle(hoist, crowd), saddle, 1e-12);
    }
  }
}

// The handle level and straight ahead, worked by hand from the data file: the dipper's floor stands
// at the rake angle, and its handle pin is reach + crowd out from the saddle.
TEST_F(Kinematics, LevelHandleByHand) {
  const ShovelPose X = shovel.pose(Drives{0, 1.0, 0, 0}, 0.0);
  const double rake = 61.8 * M_PI / 180;
  const Vector3d floor = X.X_WB.R * Vector3d::UnitX();
  EXPECT_NEAR(floor.x(), std::cos(rake), 1e-12);
  EXPECT_NEAR(floor.z(), std::sin(rake), 1e-12);
  const Vector3d p_WE = X.X_WB * machine.dipper.handle_end;
  EXPECT_NEAR((p_WE - Vector3d(9.2 + 7.75 + 1, 0, 10.8)).norm(), 0, 1e-12);
  EXPECT_NEAR((X.X_WD.p - X.X_WB * Vector3d(0, 0, 1.5)).norm(), 0, 1e-12);
}

TEST_F(Kinematics, SwingTurnsLeftAndTheBaseMovesAll) {
  const Pose base{Quaterniond::Identity(), Vector3d(-0.5, 0, 0)};
  const ShovelKinematics moved(machine, base, machine.dipper.base_rake);
  const Vector3d ahead = shovel.pose({-2, 0, 0, 0}).X_WB.p;
  const Vector3d left = shovel.pose({-2, 0, M_PI / 2, 0}).X_WB.p;
  EXPECT_NEAR((left - Vector3d(0, ahead.x(), ahead.z())).norm(), 0, 1e-12);
  EXPECT_NEAR((moved.pose({-2, 0, 0, 0}).X_WB.p - ahead - base.p).norm(), 0, 1e-12);
}

// Open, the door's free edge moves away from the dipper's rear (-x of B), and down when held high.
TEST_F(Kinematics, TheDoorOpensRearwards) {
  const ShovelPose shut = shovel.pose(Drives{-10, 1, 0, 0});
  const ShovelPose open = shovel.pose(Drives{-10, 1, 0, 1.2});
  const Vector3d edge_D(0, 0, -3);
  const Vector3d moved_B = inverse(shut.X_WB) * (open.X_WD * edge_D) - Vector3d(0, 0, -1.5);
  EXPECT_LT(moved_B.x(), -2.5);
  EXPECT_LT((open.X_WD * edge_D).z(), (shut.X_WD * edge_D).z() - 1);
}

TEST_F(Kinematics, RakeTurnsTheDipperAboutTheHandlesEnd) {
  const double more = 4 * M_PI / 180;
  const ShovelKinematics steeper(machine, Pose{}, machine.dipper.base_rake + more);
  const Drives d{0, 0, 0, 0};
  const PoseDistance apart = distance(shovel.pose(d, -0.5).X_WB, steeper.pose(d, -0.5).X_WB);
  EXPECT_NEAR(apart.radians, more, 1e-12);
  EXPECT_NEAR((shovel.pose(d, -0.5).X_WB * machine.dipper.handle_end -
               steeper.pose(d, -0.5).X_WB * machine.dipper.handle_end)
                  .norm(),
              0, 1e-12);
}

TEST_F(Kinematics, UnreachableHoistSaysWhatIsReachable) {
  try {
    shovel.saddle_angle(-30, 0);
    FAIL();
  } catch (const std::domain_error& e) {
    EXPECT_THAT(e.what(), HasSubstr("at this crowd hoist reaches from"));
  }
}

TEST_F(Kinematics, CheckNamesEveryLimitWithTimeValueAndLimit) {
  const auto messages = shovel.check(motion("0,0,0,0,0\n1,-4,3.5,60,-5\n2,-4,3.5,60,-5\n"));
  EXPECT_THAT(
      messages,
      testing::UnorderedElementsAre(
          HasSubstr("crowd is 3.500 m at"), HasSubstr("door is -5.000 deg at"),
          HasSubstr("hoist speed is -6.000 m/s at 0.500 s, below the limit of -1.800 m/s"),
          HasSubstr("crowd speed is"), HasSubstr("swing speed is 90.000 deg/s at 0.500 s")));
}

TEST_F(Kinematics, CheckSeesTheGround) {
  EXPECT_THAT(shovel.check(motion("0,0.3,0,0,0\n1,0.3,0,0,0\n")),
              ElementsAre(HasSubstr("lowest point is -")));
}

TEST_F(Kinematics, TheCasesMotionsAreWithinTheLimits) {
  for (const char* name : {"quick", "aitik"}) {
    const Motion m = Motion::load(kSource / "cases" / name / "motion.csv");
    EXPECT_THAT(shovel.check(m), IsEmpty()) << name;
  }
}

// The narrow case: where the recipe says the teeth are.
TEST_F(Kinematics, QuickStartsAtTheToeAndDumpsHigh) {
  const Motion m = Motion::load(kSource / "tests/coupler/case/narrow/motion.csv");
  const Vector3d teeth_B(4.6, 0, -1.5);
  const Vector3d start = shovel.pose(m.value(0)).X_WB * teeth_B;
  EXPECT_NEAR((start - Vector3d(13.1, 0, 0.45)).norm(), 0, 1e-3);
  const ShovelPose dump = shovel.pose(m.value(m.end_ns()));
  const Vector3d floor = dump.X_WB.R * Vector3d::UnitX();
  EXPECT_GT(floor.z(), std::sin(50 * M_PI / 180));
  EXPECT_GT((dump.X_WD * Vector3d(0, 0, -3)).z(), 7.5);  // door over a 6.5 m rim
  EXPECT_NEAR(dump.X_WB.p.head<2>().norm(), 19.4, 0.3);
}

}  // namespace
}  // namespace dipper::machine
