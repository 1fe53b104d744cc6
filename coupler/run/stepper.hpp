// Steps a run window by window.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "coupler/run/observer.hpp"

namespace dipper::run {

/// Steps a coupling and calls its observers after each window, in the order they were added, while
/// the rock computes the next.
class Stepper {
 public:
  /// \param window_steps  DEM steps in a window
  /// \param end_step      DEM steps of the run; the last window may be shorter
  Stepper(core::Coupling& coupling, std::int64_t window_steps, std::int64_t end_step);

  /// `observer` must outlive this.
  void add(Observer& observer) { observers_.push_back(&observer); }

  /// Ends the run early, before the first window at whose start `done` is true for the machine.
  void end_when(std::function<bool(const core::MachineState&)> done) { done_ = std::move(done); }

  /// Starts a new run; not called for a resumed one.
  const core::Window& start();

  /// Steps to the end, or until `stop`, called before each window, is true. Returns whether the end
  /// is reached.
  bool run(const std::function<bool()>& stop);

  /// Wall time from the start of `run` to the end of its last window [s].
  double wall_s() const { return wall_s_; }

 private:
  void notify();
  /// DEM steps in a window that begins at this step.
  std::int64_t steps_from(std::int64_t dem_step) const;
  bool at_end() const;

  core::Coupling& coupling_;
  std::int64_t window_steps_, end_step_;
  std::function<bool(const core::MachineState&)> done_;
  std::vector<Observer*> observers_;
  core::Window last_;
  bool notified_ = true;  ///< observers have had the last window
  double wall_s_ = 0;
};

}  // namespace dipper::run
