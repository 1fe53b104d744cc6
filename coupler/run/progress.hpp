// The progress line of a run.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>
#include <utility>

#include "common/reporter.hpp"
#include "coupler/case/case.hpp"
#include "coupler/run/motion_phases.hpp"
#include "coupler/run/observer.hpp"
#include "coupler/run/preparation.hpp"

namespace dipper::run {

/// Shows progress, pass and phase, payload in the dipper, estimated time left, and simulated
/// seconds per second, in 79 columns. With limited drives, which may take longer than their motion,
/// progress is measured along the motion and no end time is shown.
class Progress final : public Observer {
 public:
  using Clock = std::chrono::steady_clock;

  /// \param machine, rock  whose channels have path_time and mass_in_dipper
  Progress(Reporter& reporter, const cases::Case& c, const RunEnd& end,
           const core::ServerInfo& machine, const core::ServerInfo& rock,
           std::function<Clock::time_point()> now = Clock::now);
  void window(const core::Window& w) override;

  /// The passes of an operator who plans, as far as they are known.
  struct Passes {
    int pass = 0;      ///< the current one, from 1
    double end_s = 0;  ///< of the last one, expected; on the motion that limited drives follow
  };
  /// Measures progress by the passes, which end earlier than the run's time allows.
  void follow(std::function<Passes()> passes) { passes_ = std::move(passes); }

 private:
  Reporter& reporter_;
  std::function<Clock::time_point()> now_;
  struct State {
    Clock::time_point wall;
    double t_s,
        progress_s;  ///< position on what has a known end: time, or the motion of limited drives
  };
  std::optional<State> first_;  ///< at the end of the first window: starting up does not count
  double end_s_;
  bool by_motion_;                        ///< the run ends with the motion
  std::function<Passes()> passes_;        ///< empty unless an operator plans
  std::optional<MotionPhases> phases_;    ///< only for a shovel that follows its motion
  std::optional<std::size_t> payload_;    ///< only for a shovel
  std::optional<std::size_t> path_time_;  ///< only for limited drives: their position on the motion
};

}  // namespace dipper::run
