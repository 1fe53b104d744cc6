// The schemes against known answers: two oscillators coupled through their common spring, and the
// order of convergence and energy behaviour that docs/coupling.md states.
#include "coupler/core/coupling.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/coupler/core/advance.hpp"

namespace dipper::core {
namespace {

using Eigen::Vector2d;

/// A mass on its own spring, along x, driven by the held force; integrated exactly.
class MassSpring final : public Machine {
 public:
  MassSpring(double m, double k, double x0, double v0) : m_(m), k_(k), x_(x0, v0) {}

  ServerInfo info() const override { return {"analytic", {"mass"}, {}, 0}; }
  MachineState state(std::int64_t t_next_ns) override {
    MachineState s;
    s.t_ns = t_ns_;
    s.bodies.resize(1);
    s.bodies[0].X_WB.p.x() = x_[0];
    s.bodies[0].V_WB_W.v.x() = x_[1];
    s.contact = t_ns_ < 10'000'000;
    const double h = static_cast<double>(t_next_ns - t_ns_) * 1e-9;
    s.X_WB_next.resize(1);
    s.X_WB_next[0].p.x() = x_[0] + h * (x_[1] + 0.5 * h * (f_ - k_ * x_[0]) / m_);
    return s;
  }
  MachineState step(const MachineStep& step) override {
    const double h = static_cast<double>(step.t_end_ns - t_ns_) * 1e-9;
    const double f = f_ = step.F_Bo_W[0].force.x();
    if (k_ == 0) {
      x_ = {x_[0] + x_[1] * h + 0.5 * f / m_ * h * h, x_[1] + f / m_ * h};
    } else {
      // x = f/k + A cos wt + B sin wt
      const double w = std::sqrt(k_ / m_), c = std::cos(w * h), s = std::sin(w * h);
      const double a = x_[0] - f / k_;
      x_ = {f / k_ + a * c + x_[1] / w * s, -a * w * s + x_[1] * c};
    }
    t_ns_ = step.t_end_ns;
    return state(step.t_next_ns);
  }
  void save(const std::filesystem::path&) override {}
  void load(const std::filesystem::path&) override {}

  double energy(double k_other) const {
    return 0.5 * m_ * x_[1] * x_[1] + 0.5 * (k_ + k_other) * x_[0] * x_[0];
  }

 private:
  double m_, k_, f_ = 0;
  Vector2d x_;
  std::int64_t t_ns_ = 0;
};

/// The rock as a spring k12 between the wall and a second mass on its own spring k2, stepped by
/// velocity Verlet at dt, as DEM does; with m2 = 0 only the spring to the ground is left.
class SpringRock final : public LocalRock {
 public:
  SpringRock(double dt, double k12, double m2, double k2, double x2)
      : dt_(dt), k12_(k12), m2_(m2), k2_(k2), x2_(x2) {}

  ServerInfo info() const override { return {"analytic", {"mass"}, {}, dt_}; }
  RockState place(const std::vector<Pose>& X) override {
    x1_ = X[0].p.x();
    return report(0);
  }
  RockState step(const RockStep& step) override {
    received.push_back(step);
    const std::int64_t n = step.n_steps;
    const double v1 = (step.X_WB_target[0].p.x() - x1_) / (static_cast<double>(n) * dt_);
    double sum = 0.5 * k12_ * (x2_ - x1_);
    for (std::int64_t i = 0; i < n; ++i) {
      if (m2_ > 0) {
        v2_ += 0.5 * dt_ * force2() / m2_;
        x2_ += dt_ * v2_;
      }
      x1_ += dt_ * v1;
      if (m2_ > 0) v2_ += 0.5 * dt_ * force2() / m2_;
      sum += k12_ * (x2_ - x1_) * (i + 1 < n ? 1.0 : 0.5);
    }
    step_ += n;
    return report(sum / static_cast<double>(n));
  }
  void save(const std::filesystem::path&) override {}
  std::vector<RockStep> received;
  std::string state_hash() override { return ""; }
  double x2() const { return x2_; }

 private:
  double force2() const { return -k2_ * x2_ - k12_ * (x2_ - x1_); }
  RockState report(double mean) const {
    RockState s;
    s.step = step_;
    s.t_ns = std::llround(static_cast<double>(step_) * dt_ * 1e9);
    s.bodies.resize(1);
    s.bodies[0].mean.force.x() = mean;
    s.bodies[0].end.force.x() = k12_ * (x2_ - x1_);
    s.bodies[0].X_WB.p.x() = x1_;
    return s;
  }
  double dt_, k12_, m2_, k2_, x2_, x1_ = 0, v2_ = 0;
  std::int64_t step_ = 0;
};

/// preCICE's two-mass oscillator: m = 1, k = 4 pi^2, 16 pi^2, 4 pi^2, u0 = (1, 0), v0 = 0, with
/// u1,2 = (cos 2 pi t ± cos 6 pi t) / 2. \return |u1 error| at t = 0.1 s, where u1 = 0.25.
double oscillator_error(Scheme scheme, std::int64_t n_per_window) {
  const double k = 4 * M_PI * M_PI, k12 = 16 * M_PI * M_PI, dt = 1e-6;
  MassSpring left(1, k, 1, 0);
  SpringRock right(dt, k12, 1, k, 0);
  Coupling coupling(left, right, scheme);
  coupling.start();
  MachineState end;
  for (std::int64_t i = 0; i < 100'000 / n_per_window; ++i) {
    end = advance(coupling, n_per_window).machine;
  }
  return std::abs(end.bodies[0].X_WB.p.x() - 0.25);
}

TEST(Coupling, TwoMassOscillatorReachesThePublishedValues) {
  EXPECT_LT(oscillator_error(Scheme::corrected, 100), 2e-5);  // H = 0.1 ms
  EXPECT_LT(oscillator_error(Scheme::serial, 100), 5e-3);
}

TEST(Coupling, CorrectedConvergesFasterThanSerial) {
  const auto order = [](Scheme s, std::int64_t n) {
    return std::log2(oscillator_error(s, 2 * n) / oscillator_error(s, n));
  };
  EXPECT_NEAR(order(Scheme::serial, 1000), 1.0, 0.2);
  EXPECT_GT(order(Scheme::corrected, 1000), 1.7);
}

/// Growth of amplitude per radian of a free mass against a spring to the ground, coupled with
/// window H (the table of docs/coupling.md).
double growth_per_radian(Scheme scheme, double wH) {
  const double dt = 1e-5;
  const std::int64_t n = 200;
  const double w = wH / (static_cast<double>(n) * dt);
  MassSpring mass(1, 0, 1, 0);
  SpringRock spring(dt, w * w, 0, 0, 0);
  Coupling coupling(mass, spring, scheme);
  coupling.start();
  const auto windows = static_cast<int>(std::ceil(40 / wH));
  for (int i = 0; i < windows; ++i) advance(coupling, n);
  const double e0 = mass.energy(w * w);
  for (int i = 0; i < windows; ++i) advance(coupling, n);
  return 0.5 * std::log(mass.energy(w * w) / e0) / (windows * wH);
}

TEST(Coupling, SerialInjectsEnergyAndCorrectedTakesALittleOut) {
  EXPECT_NEAR(growth_per_radian(Scheme::serial, 0.1), 0.0495, 0.004);
  EXPECT_NEAR(growth_per_radian(Scheme::serial, 0.2), 0.0962, 0.006);
  EXPECT_NEAR(growth_per_radian(Scheme::corrected, 0.1), -0.00025, 0.0002);
  EXPECT_NEAR(growth_per_radian(Scheme::corrected, 0.2), -0.0019, 0.0006);
  EXPECT_NEAR(growth_per_radian(Scheme::corrected, 0.5), -0.026, 0.006);
  EXPECT_NEAR(growth_per_radian(Scheme::serial, 0.5), 0.204, 0.02);
  EXPECT_NEAR(growth_per_radian(Scheme::corrected, 1.0), -0.35, 0.05);
  EXPECT_NEAR(growth_per_radian(Scheme::corrected, 1.5), 0.23, 0.05) << "unstable";
}

TEST(Coupling, ResidualIsTheEnergyTheSchemeMade) {
  // Undamped and conservative on both sides: what the books say the coupling made must be what the
  // total energy has gained.
  const double dt = 1e-5, k = 1e4;
  for (const Scheme scheme : {Scheme::serial, Scheme::corrected}) {
    MassSpring mass(1, 0, 1, 0);
    SpringRock spring(dt, k, 0, 0, 0);
    Coupling coupling(mass, spring, scheme);
    coupling.start();
    double made = 0, x_wall = 1;
    for (int i = 0; i < 500; ++i) {
      const Window w = advance(coupling, 50);
      made += w.machine_work_J - w.rock_work_J;
      x_wall = w.rock.bodies[0].X_WB.p.x();
    }
    const double kinetic = mass.energy(0);
    const double stored = 0.5 * k * x_wall * x_wall;
    const double gained = kinetic + stored - 0.5 * k;
    EXPECT_NEAR(made, gained, 0.01 * std::abs(gained) + 1e-6 * k) << made << " " << gained;
  }
}

class CouplingSchemes : public testing::TestWithParam<Scheme> {};

TEST_P(CouplingSchemes, IsCountedForBothSidesAndGoneOnFrom) {
  const Scheme scheme = GetParam();
  const auto machine = [] { return MassSpring(1, 0, 0, 1); };
  const auto rock = [] { return SpringRock(1e-3, 10, 0, 0, 0); };
  MassSpring mass = machine();
  SpringRock spring = rock();
  Coupling whole(mass, spring, scheme);
  whole.start();
  advance(whole, 4);
  EXPECT_EQ(advance(whole, 6).step_index, 2);
  EXPECT_EQ(whole.state().step_index, 2);
  EXPECT_EQ(whole.state().dem_step, 10);
  EXPECT_EQ(spring.received.at(1).step_index, 1);
  EXPECT_EQ(spring.received.at(1).t_end_ns, 10'000'000);
  EXPECT_TRUE(spring.received.at(1).contact);

  SpringRock again = rock();
  Coupling resumed(mass, again, scheme);
  resumed.resume(whole.state());
  EXPECT_EQ(resumed.t_ns(), whole.t_ns());
  EXPECT_EQ(advance(resumed, 5).step_index, 3);
  EXPECT_EQ(again.received.at(0).t_end_ns, 15'000'000);
  EXPECT_FALSE(again.received.at(0).contact) << "as the machine was when the window began";
}
INSTANTIATE_TEST_SUITE_P(Schemes, CouplingSchemes,
                         testing::Values(Scheme::serial, Scheme::corrected));

TEST(Coupling, RefusesSidesWithDifferentBodies) {
  class Other final : public Machine {
    ServerInfo info() const override { return {"", {"dipper", "door"}, {}, 0}; }
    MachineState state(std::int64_t) override { return {}; }
    MachineState step(const MachineStep&) override { return {}; }
    void save(const std::filesystem::path&) override {}
    void load(const std::filesystem::path&) override {}
  } machine;
  SpringRock rock(1e-3, 1, 0, 0, 0);
  EXPECT_THROW(Coupling(machine, rock, Scheme::serial), std::runtime_error);
}

}  // namespace
}  // namespace dipper::core
