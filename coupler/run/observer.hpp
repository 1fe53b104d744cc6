// Who wants to know how a run goes.
#pragma once

#include "coupler/core/coupling.hpp"

namespace dipper::run {

/// Told by the stepper (stepper.hpp) of a run's windows as they are done.
class Observer {
 public:
  virtual ~Observer() = default;

  /// Whether both sides have to stand still while `window` is told of this one. Else the rock steps
  /// the next meanwhile.
  virtual bool needs_rest(const core::Window&) const { return false; }

  /// A window has been stepped; index 0: the start, before the first.
  virtual void window(const core::Window& w) = 0;

  /// No more windows come: the end is reached or the run is interrupted. Not after a failure.
  virtual void end() {}
};

}  // namespace dipper::run
