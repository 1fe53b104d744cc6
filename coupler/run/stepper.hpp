// A run from window to window.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "coupler/run/observer.hpp"

namespace dipper::run {

/// Advances a coupling and tells its observers of each window, in the order they were added, while
/// the rock steps the next.
class Stepper {
 public:
  /// \param window_steps  DEM steps a window
  /// \param end_step      DEM steps of the run; the last window is shorter where it must be
  Stepper(core::Coupling& coupling, std::int64_t window_steps, std::int64_t end_step);

  /// `observer` must live as long as this.
  void add(Observer& observer) { observers_.push_back(&observer); }

  /// Ends a run before its last step, as soon as the machine is so; asked before each window.
  void end_when(std::function<bool(const core::MachineState&)> done) { done_ = std::move(done); }

  /// The start of a new run; one that goes on from a checkpoint has none.
  const core::Window& start();

  /// Steps until the end, or until `stop` says so: asked before each window. Whether the end is
  /// reached.
  bool run(const std::function<bool()>& stop);

  /// The last window; index 0 and no bodies when there has been none.
  const core::Window& last() const { return last_; }

  /// Wall time from the begin of `run` to the end of its last window [s].
  double wall_s() const { return wall_s_; }

 private:
  void tell();
  /// DEM steps of a window that begins there.
  std::int64_t steps_from(std::int64_t dem_step) const;
  bool at_end() const;

  core::Coupling& coupling_;
  std::int64_t window_steps_, end_step_;
  std::function<bool(const core::MachineState&)> done_;
  std::vector<Observer*> observers_;
  core::Window last_;
  bool told_ = true;  ///< of the last window
  double wall_s_ = 0;
};

}  // namespace dipper::run
