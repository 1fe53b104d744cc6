// Detects a force on the dipper that jumps from step to step, which is an artefact of the time
// step.
#pragma once

#include <filesystem>

#include "analysis/signals/phases.hpp"
#include "common/record/columns.hpp"

namespace dipper::analysis::metrics {

/// A record's force on the dipper, at the end of each window beside the window's mean. A rock that
/// is pressed between walls by many of its spheres bounces between them when the time step is too
/// long for it (deck::pressed_timestep): the force alternates, and its mean is several times the
/// true one.
class Rattle {
 public:
  /// Throws std::runtime_error naming file and dataset.
  explicit Rattle(const std::filesystem::path& record);

  /// The part of a time's windows whose force [N] at the end is off their mean by more than
  /// `jump_N`; 0 where there is no window.
  double share(const signals::TimeSpan& time, double jump_N) const;

 private:
  record::Columns columns_;
};

}  // namespace dipper::analysis::metrics
