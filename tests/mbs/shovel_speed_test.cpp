// What a sync step costs beside the same equations of motion written by hand.
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <vector>

#include "tests/mbs/shovel_fixture.hpp"
#include "tests/mbs/shovel_tree.hpp"

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
  static constexpr double kWindow_s = 2e-3;

  struct Cost {
    double window_s = 0, by_hand_s = 0;  ///< processor time of a window, and of the equations once
    double realtime() const { return kWindow_s / window_s; }
    double evaluations() const { return window_s / by_hand_s; }
  };

  /// Of the dig of the narrow case with a rough load, each window with where it will be next.
  /// Windows and equations take turns, so that what slows the processor slows both.
  Cost cost(machine::DriveMode mode, bool segmented, int windows, CacheFiller* between = nullptr) {
    machine.rope.segmented = segmented;
    Shovel shovel(machine, quick(), Pose{}, rake, kLongestSubstep_ns, mode);
    Cost mean;
    for (int i = 1; i <= windows; ++i) {
      const double t = kWindow_s * i;
      const std::vector<Wrench> felt = {
          Wrench{Vector3d(1e5 * std::sin(3 * t), -4e5, 2e5 * std::cos(5 * t)),
                 Vector3d(1e5 * std::sin(60 * t), 5e4 * std::sin(7 * t), -5e5)},
          Wrench{Vector3d(0, 2e4, 0), Vector3d(-3e4, 0, -5e4)}};
      if (between != nullptr) between->read();
      const double start = processor_seconds();
      shovel.step({2 * i * kMillisecond, felt, 2 * (i + 1) * kMillisecond});
      const double stepped = processor_seconds();
      solve_by_hand({felt[0], felt[1]}, t);
      mean.window_s += (stepped - start) / windows;
      mean.by_hand_s += (processor_seconds() - stepped) / windows / kEvaluations;
    }
    return mean;
  }

 private:
  static constexpr int kEvaluations = 20;

  void solve_by_hand(const Wrenches& rock, double t) {
    for (int i = 0; i < kEvaluations; ++i) {
      const Joints q = Joints::Constant(0.1 * t), u = Joints::Constant(0.1 + 0.01 * i);
      const ShovelTree::Equations e =
          tree_.equations(tree_.place(q, u), rock, Vector3d(1e5, 0, 1e6));
      accelerations_ += e.mass.ldlt().solve(e.force);
    }
  }

  ShovelTree tree_{machine, Pose{}, rake, 1e4};
  Joints accelerations_ = Joints::Zero();  ///< that the compiler leaves nothing out
};

// The bounds are twice what was measured.
TEST_F(ShovelSpeed, AWindowCostsSoManyEvaluationsByHand) {
  CacheFiller rock(64 << 20);
  for (const auto mode : {machine::DriveMode::prescribed, machine::DriveMode::limited}) {
    const Cost elastic = cost(mode, false, 5000);
    const Cost cold = cost(mode, false, 300, &rock);
    const Cost segmented = cost(mode, true, 1000);
    std::printf("%s drives, x real time: %.1f, with cold caches %.1f, with segmented ropes %.2f\n",
                mode == machine::DriveMode::limited ? "limited" : "prescribed", elastic.realtime(),
                cold.realtime(), segmented.realtime());
    std::printf("  in evaluations of the equations by hand: %.0f, %.0f, %.0f\n",
                elastic.evaluations(), cold.evaluations(), segmented.evaluations());
    EXPECT_LT(elastic.evaluations(), 400);
    EXPECT_LT(segmented.evaluations(), 4500);
  }
}

}  // namespace
}  // namespace dipper::mbs
