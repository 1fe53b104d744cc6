// One line that tells how a run is doing.
#pragma once

#include <chrono>
#include <cstddef>

#include "common/reporter.hpp"
#include "coupler/run/observer.hpp"

namespace dipper::run {

/// How far it has come, how fast, what is in the dipper, and how long it will take yet.
class Progress final : public Observer {
 public:
  /// \param payload  where the rock's channels have the mass in the dipper [kg]
  Progress(Reporter& reporter, double start_s, double end_s, std::size_t payload);
  void window(const core::Window& w) override;

 private:
  Reporter& reporter_;
  std::chrono::steady_clock::time_point began_;
  double start_s_, end_s_;
  std::size_t payload_;
};

}  // namespace dipper::run
