// Measures the time that the rock takes.
#pragma once

#include <chrono>

#include "coupler/core/server.hpp"

namespace dipper::run {

/// Forwards to a rock; keeps the wall time of its steps and its last state.
class TimedRock final : public core::Rock {
 public:
  explicit TimedRock(core::Rock& rock) : rock_(rock) {}
  core::ServerInfo info() const override { return rock_.info(); }
  core::RockState place(const std::vector<Pose>& X_WB) override {
    return last_ = rock_.place(X_WB);
  }
  void start(const core::RockStep& step) override {
    began_ = Clock::now();
    rock_.start(step);
  }
  core::RockState finish() override {
    last_ = rock_.finish();
    busy_s_ += std::chrono::duration<double>(Clock::now() - began_).count();
    return last_;
  }
  void save(const std::filesystem::path& file) override { rock_.save(file); }
  HeightMap look(const HeightGrid& grid) override { return rock_.look(grid); }
  std::string state_hash() override { return rock_.state_hash(); }

  double busy_s() const { return busy_s_; }
  const core::RockState& last() const { return last_; }

 private:
  using Clock = std::chrono::steady_clock;
  core::Rock& rock_;
  Clock::time_point began_;
  double busy_s_ = 0;
  core::RockState last_;
};

}  // namespace dipper::run
