// How long the coupling waits for the rock.
#pragma once

#include <chrono>

#include "coupler/core/server.hpp"

namespace dipper::run {

/// A rock and the wall time its steps take.
class TimedRock final : public core::Rock {
 public:
  explicit TimedRock(core::Rock& rock) : rock_(rock) {}
  core::ServerInfo info() const override { return rock_.info(); }
  void set_sync_time(const core::SyncTime& now) override { rock_.set_sync_time(now); }
  core::RockState place(const std::vector<Pose>& X_WB) override { return rock_.place(X_WB); }
  void set_contact(bool on) override { rock_.set_contact(on); }
  core::RockState step(std::int64_t n_steps, const std::vector<Pose>& X_WB_target) override {
    using Clock = std::chrono::steady_clock;
    const auto began = Clock::now();
    core::RockState s = rock_.step(n_steps, X_WB_target);
    wait_s_ += std::chrono::duration<double>(Clock::now() - began).count();
    return s;
  }
  void save(const std::filesystem::path& file) override { rock_.save(file); }
  std::string state_hash() override { return rock_.state_hash(); }

  double wait_s() const { return wait_s_; }

 private:
  core::Rock& rock_;
  double wait_s_ = 0;
};

}  // namespace dipper::run
