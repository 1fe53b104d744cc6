// A rock that is one stiff plane, which the middle of the tooth tips runs into: for coupled tests
// without a DEM.
#pragma once

#include <algorithm>
#include <stdexcept>

#include "coupler/core/server.hpp"

namespace dipper::mbs {

/// F = k d along the normal, d the depth of the teeth behind the plane; no damping.
class WallRock final : public core::LocalRock {
 public:
  static constexpr double kTimestep_s = 3e-4;

  WallRock(const Vector3d& teeth_B, const Vector3d& at, const Vector3d& normal, double stiffness)
      : teeth_B_(teeth_B), at_(at), normal_(normal), stiffness_(stiffness) {}

  void take_away() { there_ = false; }

  core::ServerInfo info() const override { return {"wall", {"dipper", "door"}, {}, kTimestep_s}; }
  core::RockState place(const std::vector<Pose>& X_WB) override {
    X_WB_ = X_WB;
    return report({load(X_WB[0]), Wrench{}}, {load(X_WB[0]), Wrench{}});
  }
  core::RockState step(const core::RockStep& step) override {
    const std::int64_t n_steps = step.n_steps;
    const std::vector<Pose>& target = step.X_WB_target;
    const double H = static_cast<double>(n_steps) * kTimestep_s;
    const Twist V = twist_between(X_WB_[0], target[0], H);
    Wrench mean, end = load(X_WB_[0]);
    for (std::int64_t i = 0; i <= n_steps; ++i) {
      end = load(moved(X_WB_[0], V, static_cast<double>(i) * kTimestep_s));
      const double weight = (i == 0 || i == n_steps ? 0.5 : 1.0) / static_cast<double>(n_steps);
      mean.torque += weight * end.torque;
      mean.force += weight * end.force;
    }
    X_WB_ = target;
    step_ += n_steps;
    return report({mean, Wrench{}}, {end, Wrench{}});
  }
  void save(const std::filesystem::path&) override {}
  std::string state_hash() override { return ""; }

 private:
  static Pose moved(const Pose& X, const Twist& V, double t) {
    return {from_rotation_vector(V.w * t) * X.R, X.p + V.v * t};
  }
  Wrench load(const Pose& X_WB) const {
    const Vector3d lever = X_WB.R * teeth_B_;
    const double depth = -(X_WB.p + lever - at_).dot(normal_);
    if (!there_ || depth <= 0) return {};
    const Vector3d force = stiffness_ * depth * normal_;
    return {lever.cross(force), force};
  }
  core::RockState report(const std::vector<Wrench>& mean, const std::vector<Wrench>& end) const {
    core::RockState s;
    s.step = step_;
    for (std::size_t b = 0; b < 2; ++b) s.bodies.push_back({mean[b], end[b], X_WB_[b]});
    return s;
  }

  Vector3d teeth_B_, at_, normal_;
  double stiffness_;
  bool there_ = true;
  std::vector<Pose> X_WB_;
  std::int64_t step_ = 0;
};

}  // namespace dipper::mbs
