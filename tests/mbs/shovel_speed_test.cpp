// How much faster than the real machine it runs: windows of 2 ms, each with where it will be next.
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <vector>

#include "tests/mbs/shovel_fixture.hpp"

namespace dipper::mbs {
namespace {

double processor_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Other data fill the processor's caches, as the rock's do between two windows of a paired run.
class CacheFiller {
 public:
  explicit CacheFiller(std::size_t bytes) : data_(bytes / sizeof(std::uint64_t), 1) {}
  std::uint64_t read() {
    for (const std::uint64_t x : data_) sum_ += x;
    return sum_;
  }

 private:
  std::vector<std::uint64_t> data_;
  std::uint64_t sum_ = 0;
};

class ShovelSpeed : public ShovelTest {
 protected:
  /// Simulated time over processor time, of the dig of the narrow case with a rough load.
  double realtime_factor(machine::DriveMode mode, bool segmented, int windows,
                         CacheFiller* between = nullptr) {
    machine.rope.segmented = segmented;
    Shovel shovel(machine, quick(), Pose{}, rake, kLongestSubstep_ns, mode);
    double took_s = 0;
    for (int i = 1; i <= windows; ++i) {
      const double t = 2e-3 * i;
      const std::vector<Wrench> felt = {
          Wrench{Vector3d(1e5 * std::sin(3 * t), -4e5, 2e5 * std::cos(5 * t)),
                 Vector3d(1e5 * std::sin(60 * t), 5e4 * std::sin(7 * t), -5e5)},
          Wrench{Vector3d(0, 2e4, 0), Vector3d(-3e4, 0, -5e4)}};
      if (between != nullptr) between->read();
      const double before = processor_seconds();
      shovel.step({2 * i * kMillisecond, felt, 2 * (i + 1) * kMillisecond});
      took_s += processor_seconds() - before;
    }
    return 2e-3 * windows / took_s;
  }
};

// The bounds are for a busy core.
TEST_F(ShovelSpeed, ManyTimesRealTime) {
  CacheFiller rock(64 << 20);
  for (const auto mode : {machine::DriveMode::prescribed, machine::DriveMode::limited}) {
    const double elastic = realtime_factor(mode, false, 5000);
    const double cold = realtime_factor(mode, false, 300, &rock);
    const double segmented = realtime_factor(mode, true, 1000);
    std::printf("%s drives: %.0f x real time, with cold caches %.0f, with segmented ropes %.0f\n",
                mode == machine::DriveMode::limited ? "limited" : "prescribed", elastic, cold,
                segmented);
    EXPECT_GT(elastic, 8);
    EXPECT_GT(cold, 2);
    EXPECT_GT(segmented, 0.5);
  }
}

}  // namespace
}  // namespace dipper::mbs
