#include "machine/motion.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/common/input_errors.hpp"

namespace dipper::machine {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr char kHeader[] = "time_s,hoist_m,crowd_m,swing_deg,door_deg\n";
constexpr std::int64_t kSecond = 1'000'000'000;

Motion rows(const std::string& text) { return Motion::parse(kHeader + text, "m.csv"); }

std::vector<std::string> faults(const std::string& text) {
  return test::faults_of([&] { Motion::parse(text, "m.csv"); });
}

TEST(Motion, PassesThroughItsRowsInSiUnits) {
  const Motion m = rows("0,0,-1.5,0,0\n1,-1,0,90,0\n2,-3,0.5,90,45\n");
  EXPECT_DOUBLE_EQ(m.value(kSecond).hoist, -1);
  EXPECT_DOUBLE_EQ(m.value(kSecond).swing, M_PI / 2);
  EXPECT_DOUBLE_EQ(m.value(2 * kSecond).door, M_PI / 4);
  EXPECT_EQ(m.start_ns(), 0);
  EXPECT_EQ(m.end_ns(), 2 * kSecond);
  EXPECT_EQ(m.next_row_ns(0), kSecond);
  EXPECT_EQ(m.next_row_ns(kSecond - 1), kSecond);
}

TEST(Motion, StandsStillOutsideItsRows) {
  const Motion m = rows("0,0,0,0,0\n1,-1,1,10,0\n");
  EXPECT_EQ(m.value(-5 * kSecond).crowd, 0);
  EXPECT_EQ(m.value(9 * kSecond).crowd, 1);
  EXPECT_EQ(m.rate(9 * kSecond).crowd, 0);
  EXPECT_EQ(m.acceleration(9 * kSecond).crowd, 0);
}

// A straight line, given at uneven times, between rests: exact but in the first and last interval.
TEST(Motion, KeepsAConstantSpeed) {
  const Motion m = rows("0,0,0,0,0\n1,1,0,0,0\n1.5,1.5,0,0,0\n3,3,0,0,0\n4,4,0,0,0\n");
  for (double t = 1; t < 3; t += 0.01) {
    EXPECT_NEAR(m.at(t).position.hoist, t, 1e-12);
    EXPECT_NEAR(m.at(t).rate.hoist, 1, 1e-12);
    EXPECT_NEAR(m.at(t).acceleration.hoist, 0, 1e-11);
  }
}

TEST(Motion, IsMonotoneBetweenRowsAndItsRateIsContinuous) {
  const Motion m = rows("0,0,0,0,0\n1,-0.01,0,0,0\n2,-5,0,0,0\n2.5,-5,0,0,0\n4,-5.1,0,0,0\n");
  double last = 0, last_rate = 0;
  for (int i = 1; i <= 40000; ++i) {
    const DriveState s = m.at(i * 1e-4);
    EXPECT_LE(s.position.hoist, last);
    EXPECT_LT(std::abs(s.rate.hoist - last_rate), 1e-4 * 41);  // |acceleration| < 40
    last = s.position.hoist;
    last_rate = s.rate.hoist;
  }
}

TEST(Motion, RateAndAccelerationAreDerivatives) {
  const Motion m = rows("0,0,0,0,0\n0.5,-0.3,0.1,3,0\n1.1,-0.8,0.4,9,2\n1.8,-1.9,0.5,12,9\n");
  constexpr double h = 1e-6;
  for (double t : {0.2, 0.7, 1.0, 1.3, 1.7}) {
    const DriveState s = m.at(t), a = m.at(t - h), b = m.at(t + h);
    EXPECT_NEAR(s.rate.hoist, (b.position.hoist - a.position.hoist) / (2 * h), 1e-8);
    EXPECT_NEAR(s.rate.swing, (b.position.swing - a.position.swing) / (2 * h), 1e-8);
    EXPECT_NEAR(s.acceleration.crowd, (b.rate.crowd - a.rate.crowd) / (2 * h), 1e-7);
  }
}

// sin^2 sampled at 0.25 s: the parabola's slopes are good to second order, the curve to 2 mm in 1
// m.
TEST(Motion, FollowsASmoothCurveBetweenSamples) {
  std::string text;
  for (int i = 0; i <= 32; ++i) {
    const double t = 0.25 * i;
    text +=
        std::to_string(t) + "," + std::to_string(std::pow(std::sin(M_PI * t / 8), 2)) + ",0,0,0\n";
  }
  const Motion m = rows(text);
  for (double t = 0; t < 8; t += 0.01) {
    EXPECT_NEAR(m.at(t).position.hoist, std::pow(std::sin(M_PI * t / 8), 2), 2e-3);
  }
}

TEST(Motion, GoesOnAsOneThatWasReadWhole) {
  const std::string begun = "0,0,0,0,0\n1,-1,0.2,10,0\n", more = "1.5,-2,0.3,20,0\n3,-2,0.3,20,5\n";
  Motion motion = rows(begun);
  motion.extend(rows(more));
  const Motion whole = rows(begun + more);
  EXPECT_EQ(motion.end_ns(), whole.end_ns());
  for (double t = 0; t < 3.1; t += 0.01) {
    const DriveState a = motion.at(t), b = whole.at(t);
    EXPECT_EQ(a.position.hoist, b.position.hoist) << t;
    EXPECT_EQ(a.rate.swing, b.rate.swing) << t;
    EXPECT_EQ(a.acceleration.crowd, b.acceleration.crowd) << t;
  }
  EXPECT_NE(motion.at(1).rate.hoist, 0) << "it does not stop where it ended before";
  EXPECT_EQ(motion.standing().at(2).position.hoist, 0);
}

TEST(Motion, DoesNotGoOnWithWhatIsPast) {
  Motion motion = rows("0,0,0,0,0\n1,-1,0,0,0\n");
  EXPECT_THROW(motion.extend(rows("1,-1,0,0,0\n2,0,0,0,0\n")), std::invalid_argument);
  EXPECT_EQ(motion.end_ns(), kSecond) << "a refused one changes nothing";
}

TEST(Motion, TakesCommentsBlankLinesAndCarriageReturns) {
  const Motion m = Motion::parse(
      "# a note\r\n\r\ntime_s,hoist_m,crowd_m,swing_deg,door_deg\r\n0,0,0,0,0\r\n# more\n 1 , "
      "+2,0,0,0\r\n",
      "m.csv");
  EXPECT_EQ(m.value(kSecond).hoist, 2);
}

TEST(MotionErrors, NameFileLineAndColumn) {
  EXPECT_THAT(faults("time_s,hoist_m\n"), ElementsAre(HasSubstr("m.csv:1:1: header is")));
  EXPECT_THAT(faults(""), ElementsAre(HasSubstr("no header")));
  EXPECT_THAT(faults(kHeader), ElementsAre(HasSubstr("0 row(s)")));
  EXPECT_THAT(faults(std::string(kHeader) + "0,0,0,0,0\n"), ElementsAre(HasSubstr("1 row(s)")));
  EXPECT_THAT(faults(std::string(kHeader) + "0,0,0,0,0\n1,0,0,0\n"),
              ElementsAre(HasSubstr("m.csv:3:8: 4 columns")));
}

TEST(MotionErrors, AreAllReportedAtOnce) {
  EXPECT_THAT(
      faults(std::string(kHeader) + "0,0,0,0,0\n1,x,0,nan,0\n1,0,0,0,0\n1,0,0,0,0\n0.5,0,0,0,\n"),
      ElementsAre("m.csv:3:3: hoist_m is \"x\"; it must be a finite number",
                  "m.csv:3:7: swing_deg is \"nan\"; it must be a finite number",
                  HasSubstr("m.csv:5:1: time_s is 1, not after"),
                  HasSubstr("m.csv:6:11: door_deg is \"\"")));
  EXPECT_THAT(
      faults(std::string(kHeader) + "3,0,0,0,0\n1,0,0,0,0\n2,0,0,0,0\n4,0,0,0,0\n"),
      ElementsAre(
          "m.csv:3:1: time_s is 1, not after the previous row (3 s), and the same in 1 more "
          "rows; dipper import sorts a log"));
  EXPECT_THAT(faults(std::string(kHeader) + "0,0,0,0,0\n1,+-2,0,0,0\n"),
              ElementsAre(HasSubstr("hoist_m is \"+-2\"")));
}

TEST(MotionErrors, RefuseWhatDoesNotFitNanoseconds) {
  EXPECT_THAT(faults(std::string(kHeader) + "0,0,0,0,0\n1e9,0,0,0,0\n"),
              testing::Contains(HasSubstr("m.csv:3:1: time_s is")));
  EXPECT_THAT(faults(std::string(kHeader) + "0,0,0,0,0\ninf,0,0,0,0\n"),
              testing::Contains(HasSubstr("m.csv:3:1: time_s is \"inf\"")));
}

TEST(MotionErrors, SayWhenTheFileIsNotThere) {
  EXPECT_THROW(Motion::load("/nowhere/motion.csv"), InputError);
}

TEST(Motion, TimesInMillisecondsAreReportedOnce) {
  const auto faults_of = [](int rows, int step) {
    std::string text = "time_s,hoist_m,crowd_m,swing_deg,door_deg\n";
    for (int k = 0; k < rows; ++k) text += std::to_string(step * k) + ",0,0,0,0\n";
    try {
      Motion::parse(text, "m.csv");
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_EQ(faults_of(113, 250),
            "m.csv:43:1: time_s is 10250; it must be within 10000 s: in ms, perhaps?");
  EXPECT_EQ(faults_of(40, 100),
            "m.csv:3:1: time_s has a row every 100 s; up to 60 s: in ms, perhaps?");
  EXPECT_EQ(faults_of(40, 20), "");
}

}  // namespace
}  // namespace dipper::machine
