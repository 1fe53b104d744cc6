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
  core::MachineState state() override { return report(t_ns_, x_, v_); }
  core::MachineState step(std::int64_t t_end_ns, const std::vector<Wrench>& F,
                          bool commit) override {
    const double h = static_cast<double>(t_end_ns - t_ns_) * 1e-9;
    const double v = v_ + F[0].force.x() / 2 * h;
    const double x = x_ + v * h;
    if (commit) {
      ++commits;
      t_ns_ = t_end_ns;
      x_ = x;
      v_ = v;
    }
    return report(t_end_ns, x, v);
  }
  void save(const std::filesystem::path&) override {}
  void load(const std::filesystem::path&) override {}
  std::atomic<int> commits{0};

 private:
  static core::MachineState report(std::int64_t t_ns, double x, double v) {
    core::MachineState s;
    s.t_ns = t_ns;
    s.bodies.resize(1);
    s.bodies[0].X_WB.p.x() = x;
    s.bodies[0].V_WB_W.v.x() = v;
    s.channels = {x};
    s.contact = t_ns < 50'000'000;
    return s;
  }
  std::int64_t t_ns_ = 0;
  double x_ = 1, v_ = 0;
};

/// A spring of 50 N/m to the origin. From `sick_from` on (in steps) its force is NaN.
class FakeRock final : public core::Rock {
 public:
  core::ServerInfo info() const override { return {"fake", {"body"}, {{"f", "N", "W"}}, 1e-3}; }
  core::RockState place(const std::vector<Pose>& X) override { return report(X[0]); }
  core::RockState step(std::int64_t n, const std::vector<Pose>& X) override {
    ++windows;
    step_ += n;
    return report(X[0]);
  }
  void set_contact(bool on) override { contact_ = on; }
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
