// The interface of what follows a run: record, progress, checkpoints.
#pragma once

#include "coupler/core/coupling.hpp"

namespace dipper::run {

/// The stepper (stepper.hpp) calls it after each window of a run.
class Observer {
 public:
  virtual ~Observer() = default;

  /// Whether both sides must be at rest during `window` for this window. Otherwise the rock
  /// computes the next window at the same time.
  virtual bool needs_rest(const core::Window&) const { return false; }

  /// A window is complete; index 0: the start, before the first.
  virtual void window(const core::Window& w) = 0;

  /// The run has reached its end or is interrupted. Not called after a failure.
  virtual void end() {}
};

}  // namespace dipper::run
