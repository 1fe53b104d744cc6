// One line that tells how a run is doing.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>

#include "common/reporter.hpp"
#include "coupler/case/case.hpp"
#include "coupler/run/motion_phases.hpp"
#include "coupler/run/observer.hpp"
#include "coupler/run/preparation.hpp"

namespace dipper::run {

/// How far it has come, pass and phase, what is in the dipper, how long it will take yet (once that
/// can be told), and simulated seconds a second: in 79 columns. Limited drives take as long for
/// their motion as they need: how far they have come is counted along it, and no end time is shown.
class Progress final : public Observer {
 public:
  using Clock = std::chrono::steady_clock;

  /// \param machine, rock  whose channels have path_time and mass_in_dipper
  Progress(Reporter& reporter, const cases::Case& c, const RunEnd& end,
           const core::ServerInfo& machine, const core::ServerInfo& rock,
           std::function<Clock::time_point()> now = Clock::now);
  void window(const core::Window& w) override;

 private:
  Reporter& reporter_;
  std::function<Clock::time_point()> now_;
  struct State {
    Clock::time_point wall;
    double t_s, way_s;  ///< way: what has an end, the time or limited drives' motion
  };
  std::optional<State> first_;  ///< as the first window ended: starting up does not count
  double end_s_;
  bool by_motion_;                        ///< it ends with the motion
  std::optional<MotionPhases> phases_;    ///< of a shovel that follows its motion
  std::optional<std::size_t> payload_;    ///< of a shovel
  std::optional<std::size_t> path_time_;  ///< of limited drives: how far along the motion they are
};

}  // namespace dipper::run
