// How much faster than the real machine it runs: windows of 2 ms, each with where it will be next.
#include <sys/resource.h>

#include <cstdio>

#include "tests/mbs/shovel_fixture.hpp"

namespace dipper::mbs {
namespace {

double user_seconds() {
  rusage r{};
  getrusage(RUSAGE_SELF, &r);
  return static_cast<double>(r.ru_utime.tv_sec) + 1e-6 * static_cast<double>(r.ru_utime.tv_usec);
}

class ShovelSpeed : public ShovelTest {
 protected:
  /// Simulated time over processor time, of the dig of the narrow case with a rough load.
  double realtime_factor(machine::DriveMode mode, bool segmented, int windows) {
    machine.rope.segmented = segmented;
    Shovel shovel(machine, quick(), Pose{}, rake, kLongestSubstep_ns, mode);
    const double before = user_seconds();
    for (int i = 1; i <= windows; ++i) {
      const double t = 2e-3 * i;
      const std::vector<Wrench> felt = {
          Wrench{Vector3d(1e5 * std::sin(3 * t), -4e5, 2e5 * std::cos(5 * t)),
                 Vector3d(1e5 * std::sin(60 * t), 5e4 * std::sin(7 * t), -5e5)},
          Wrench{Vector3d(0, 2e4, 0), Vector3d(-3e4, 0, -5e4)}};
      shovel.step({2 * i * kMillisecond, felt, 2 * (i + 1) * kMillisecond});
    }
    return 2e-3 * windows / (user_seconds() - before);
  }
};

// The bounds are for a busy core.
TEST_F(ShovelSpeed, ManyTimesRealTime) {
  for (const auto mode : {machine::DriveMode::prescribed, machine::DriveMode::limited}) {
    const double elastic = realtime_factor(mode, false, 5000);
    const double segmented = realtime_factor(mode, true, 1000);
    std::printf("%s drives: %.0f x real time, with segmented ropes %.0f\n",
                mode == machine::DriveMode::limited ? "limited" : "prescribed", elastic, segmented);
    EXPECT_GT(elastic, 8);
    EXPECT_GT(segmented, 0.5);
  }
}

}  // namespace
}  // namespace dipper::mbs
