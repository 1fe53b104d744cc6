#include "coupler/launch/hang_watch.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dipper::launch {
namespace {

using testing::HasSubstr;

TEST(HangWatch, AStoppedProgramHangs) {
  HangWatch watch(5);
  for (double t = 0; t <= 10; t += 0.5) EXPECT_EQ(watch.look(t, t, 100), "") << t;
  EXPECT_EQ(watch.look(15, 10, 100), "");
  EXPECT_THAT(watch.look(15.1, 10, 100), HasSubstr("or write anything for 5 s"));
}

TEST(HangWatch, ASlowOneThatWritesOrRunsLives) {
  HangWatch writes(5), runs(5);
  for (int k = 0; k < 800; ++k) {
    EXPECT_EQ(writes.look(4 * k, 0, static_cast<std::uintmax_t>(k)), "") << k;
    EXPECT_EQ(runs.look(4 * k, 0.01 * k, 0), "") << k;  // a quarter of a hundredth of the time
  }
}

TEST(HangWatch, RanksThatWaitForEachOtherAtFullSpeedHang) {
  HangWatch watch(5);
  for (double t = 0; t <= 3600; t += 2) ASSERT_EQ(watch.look(t, t, 100), "") << t;
  EXPECT_THAT(watch.look(3601, 3601, 100), HasSubstr("written nothing for 3600 s"));
}

TEST(HangWatch, ALargeCaseThatWritesSeldomLives) {
  HangWatch watch(5);
  double t = 0;
  for (; t <= 3000; t += 2) ASSERT_EQ(watch.look(t, t, 1), "") << t;
  for (const double slow = t + 80'000; t <= slow; t += 2) ASSERT_EQ(watch.look(t, t, 2), "") << t;
  for (const double end = t + 15'000; t <= end && watch.look(t, t, 2).empty();) t += 2;
  EXPECT_THAT(watch.look(t, t, 2), HasSubstr("it runs but has written nothing"));
}

}  // namespace
}  // namespace dipper::launch
