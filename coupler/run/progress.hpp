// One line that tells how a run is doing.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>

#include "common/reporter.hpp"
#include "coupler/case/case.hpp"
#include "coupler/run/motion_phases.hpp"
#include "coupler/run/observer.hpp"
#include "coupler/run/preparation.hpp"

namespace dipper::run {

/// How far it has come, pass and phase, what is in the dipper, how long it will take yet, and
/// simulated seconds a second: in 79 columns.
class Progress final : public Observer {
 public:
  /// \param machine, rock  whose channels have path_time and mass_in_dipper
  /// \param start_s  where the run goes on from
  Progress(Reporter& reporter, const cases::Case& c, const RunEnd& end,
           const core::ServerInfo& machine, const core::ServerInfo& rock, double start_s);
  void window(const core::Window& w) override;

 private:
  std::string pass_text(const core::Window& w, double along_s) const;

  Reporter& reporter_;
  std::chrono::steady_clock::time_point began_;
  double start_s_, end_s_;
  std::optional<MotionPhases> phases_;    ///< of a shovel
  std::size_t payload_ = 0;               ///< of a shovel
  std::optional<std::size_t> path_time_;  ///< of limited drives: how far along the motion they are
};

}  // namespace dipper::run
