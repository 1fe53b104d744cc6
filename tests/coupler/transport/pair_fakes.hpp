// A machine and a rock with simple answers, which count how often they were asked.
#pragma once

#include <atomic>
#include <limits>

#include "coupler/core/server.hpp"

namespace dipper::transport {

/// A point mass of 2 kg under the held force; semi-implicit, one step a window. It meets rock until
/// 50 ms.
class FakeMachine final : public core::Machine {
 public:
  core::ServerInfo info() const override { return {"fake", {"body"}, {{"x", "m", "W"}}, 0}; }
  core::MachineState state(std::int64_t t_next_ns) override {
    core::MachineState s;
    s.t_ns = t_ns_;
    s.bodies.resize(1);
    s.bodies[0].X_WB.p.x() = x_;
    s.bodies[0].V_WB_W.v.x() = v_;
    s.channels = {x_};
    s.contact = t_ns_ < 50'000'000;
    s.X_WB_next.resize(1);
    s.X_WB_next[0].p.x() = x_ + v_ * static_cast<double>(t_next_ns - t_ns_) * 1e-9;
    return s;
  }
  core::MachineState step(const core::MachineStep& step) override {
    const double h = static_cast<double>(step.t_end_ns - t_ns_) * 1e-9;
    v_ += step.F_Bo_W[0].force.x() / 2 * h;
    x_ += v_ * h;
    t_ns_ = step.t_end_ns;
    ++steps;
    return state(step.t_next_ns);
  }
  void save(const std::filesystem::path&) override {}
  void load(const std::filesystem::path&) override {}
  std::atomic<int> steps{0};

 private:
  std::int64_t t_ns_ = 0;
  double x_ = 1, v_ = 0;
};

/// A spring of 50 N/m to the origin. From `sick_from` on (in steps) its force is NaN.
class FakeRock final : public core::LocalRock {
 public:
  core::ServerInfo info() const override { return {"fake", {"body"}, {{"f", "N", "W"}}, 1e-3}; }
  core::RockState place(const std::vector<Pose>& X) override { return report(X[0]); }
  core::RockState step(const core::RockStep& step) override {
    ++windows;
    step_ += step.n_steps;
    contact_ = step.contact;
    return report(step.X_WB_target[0]);
  }
  void save(const std::filesystem::path&) override {}
  std::string state_hash() override { return "hash"; }
  std::atomic<int> windows{0};
  std::int64_t sick_from = std::numeric_limits<std::int64_t>::max();

 private:
  core::RockState report(const Pose& X) const {
    core::RockState s;
    s.step = step_;
    s.bodies.resize(1);
    s.bodies[0].X_WB = X;
    double f = contact_ ? -50 * X.p.x() : 0;
    if (step_ >= sick_from) f = std::numeric_limits<double>::quiet_NaN();
    s.bodies[0].mean.force.x() = s.bodies[0].end.force.x() = f;
    s.channels = {f};
    return s;
  }
  std::int64_t step_ = 0;
  bool contact_ = true;
};

}  // namespace dipper::transport
