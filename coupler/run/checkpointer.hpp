// When a run writes checkpoints.
#pragma once

#include <functional>

#include "coupler/run/checkpoint.hpp"
#include "coupler/run/observer.hpp"

namespace dipper::run {

/// Saves a checkpoint at intervals and at the end, with the record flushed up to it.
class Checkpointer final : public Observer {
 public:
  struct Sources {  ///< inputs of a checkpoint
    const core::Coupling& coupling;
    core::Machine& machine;
    core::Rock& rock;
    RunRecord& record;
    std::function<result::RunCost()> cost;
    std::function<nlohmann::json()> desk;  ///< empty without a planning operator
  };

  /// \param every_s  simulated time between checkpoints; 0: only at the end
  Checkpointer(std::filesystem::path checkpoints, double every_s, Sources sources);

  bool needs_rest(const core::Window& w) const override;
  void window(const core::Window& w) override;
  void end() override { save(); }

 private:
  void save();

  std::filesystem::path folder_;
  double every_s_;
  Sources sources_;
  std::int64_t saved_ns_;  ///< time of the last checkpoint
};

}  // namespace dipper::run
