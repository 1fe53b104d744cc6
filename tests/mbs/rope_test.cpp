// The rope on two masses, where every answer is known.
#include "tests/mbs/rope.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "tests/mbs/stepper.hpp"

namespace dipper::mbs {
namespace {

constexpr double kG = 9.81;

/// Atwood's machine: masses a (left) and b (right) hang from a rope over a sheave of radius 1 m
/// whose axis is 10 m up; coordinates of both are heights.
class Atwood {
 public:
  Atwood(double mass_a, double mass_b, double stiffness, double damping, double free_length) {
    SimTK::Force::UniformGravity(forces, matter, SimTK::Vec3(0, 0, -kG));
    const SimTK::Rotation up(-SimTK::Pi / 2, SimTK::YAxis);  // a slider's x upwards
    const auto hang = [&](double mass, double x) {
      return SimTK::MobilizedBody::Slider(
          matter.Ground(), SimTK::Transform(up, SimTK::Vec3(x, 0, 0)),
          SimTK::Body::Rigid(SimTK::MassProperties(mass, SimTK::Vec3(0), SimTK::Inertia(1))),
          SimTK::Transform(up));
    };
    a = hang(mass_a, -1);
    b = hang(mass_b, 1);
    RopeSpec spec;
    spec.sheave_body = matter.Ground();
    spec.sheave_center = SimTK::Vec3(0, 0, 10);
    spec.sheave_radius = 1;
    spec.body_a = a;
    spec.body_b = b;
    spec.axial_stiffness = stiffness * free_length;  // k = EA / L
    spec.damping = damping;
    rope = new Rope(spec, [this](const SimTK::State& s) {
      return FreeLength{length_at_start + winch_rate * s.getTime(), winch_rate};
    });
    SimTK::Force::Custom(forces, rope);
    length_at_start = free_length;
    state = system.realizeTopology();
    realize_at(system, state, 0);
  }

  /// Straight left, half a turn, straight right.
  static double path(double z_a, double z_b) { return 20 - z_a - z_b + M_PI; }

  void run(double t0, double t1, double substep = 1e-3) {
    advance(system, state, std::llround(t0 * 1e9), std::llround(t1 * 1e9),
            std::llround(substep * 1e9), powers, works);
  }

  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter{system};
  SimTK::GeneralForceSubsystem forces{system};
  SimTK::MobilizedBody a, b;
  Rope* rope = nullptr;
  double length_at_start = 0, winch_rate = 0;
  SimTK::State state;
  /// Dissipated, and put in by the winch.
  SimTK::Vector works = SimTK::Vector(2, 0.0);
  Quadrature powers = [this](const SimTK::State& s) {
    const RopeState r = rope->evaluate(s);
    SimTK::Vector p(2);
    p[0] = r.dissipation;
    p[1] = r.winch_power;
    return p;
  };
  double energy() const { return system.calcEnergy(state); }
};

// 2 kg against 1 kg: a = g/3 = 3.27 m/s^2 and T = 4 g / 3 = 13.08 N.
TEST(Atwood, AccelerationAndTension) {
  constexpr double k = 1e6;
  // Begins stretched by T/k, so there is no bounce.
  Atwood w(2, 1, k, 0, Atwood::path(0, 0) - 13.08 / k);
  EXPECT_NEAR(w.rope->evaluate(w.state).tension, 13.08, 1e-8);
  EXPECT_NEAR(w.a.getOneUDot(w.state, 0), -3.27, 1e-8);
  EXPECT_NEAR(w.b.getOneUDot(w.state, 0), 3.27, 1e-8);
  w.run(0, 1, 1e-3);
  EXPECT_NEAR(w.a.getOneQ(w.state, 0), -0.5 * 3.27, 1e-6);
  EXPECT_NEAR(w.b.getOneQ(w.state, 0), 0.5 * 3.27, 1e-6);
  EXPECT_NEAR(w.rope->evaluate(w.state).tension, 13.08, 1e-6);
}

TEST(Atwood, DampingSettlesTheBounce) {
  constexpr double k = 1e5;
  const double reduced_mass = 2.0 / 3.0;
  Atwood w(2, 1, k, 2 * std::sqrt(k * reduced_mass), Atwood::path(0, 0));
  w.run(0, 0.5, 1e-3);
  EXPECT_NEAR(w.rope->evaluate(w.state).tension, 13.08, 1e-6);
  EXPECT_NEAR(w.a.getOneUDot(w.state, 0), -3.27, 1e-6);
}

TEST(Rope, SlackCarriesExactlyNothing) {
  Atwood w(2, 1, 1e6, 1e3, Atwood::path(0, 0) + 0.5);
  const RopeState r = w.rope->evaluate(w.state);
  EXPECT_DOUBLE_EQ(r.stretch, -0.5);
  EXPECT_EQ(r.tension, 0);
  EXPECT_EQ(r.elastic_energy, 0);
  EXPECT_EQ(r.dissipation, 0);
  EXPECT_EQ(w.a.getOneUDot(w.state, 0), -kG);
  EXPECT_EQ(w.b.getOneUDot(w.state, 0), -kG);
}

TEST(Rope, NeverPushesWhenItsEndsClose) {
  Atwood w(2, 1, 1e4, 1e4, Atwood::path(0, 0) - 1e-3);  // T_e = 10 N
  w.a.setOneU(w.state, 0, 1);                           // 1 m/s: damping alone would give -1e4 N
  realize_at(w.system, w.state, 0);
  const RopeState r = w.rope->evaluate(w.state);
  EXPECT_EQ(r.tension, 0);
  EXPECT_NEAR(r.dissipation, 10, 1e-9);  // T_e ds/dt: the energy of the stretch it gives up
}

// Dropped 0.5 m with a slack rope, then snapped taut, again and again: what the bounces lose is
// what the damper took.
TEST(Rope, SnapTautKeepsItsEnergyBooks) {
  for (double damping : {0.0, 50.0}) {
    Atwood w(2, 1, 2e4, damping, Atwood::path(0, 0) + 0.5);
    const double before = w.energy();
    double peak = 0;
    bool was_slack_again = false;
    for (int i = 0; i < 1500; ++i) {
      w.run(i * 1e-3, (i + 1) * 1e-3, 2e-5);
      const RopeState r = w.rope->evaluate(w.state);
      EXPECT_GE(r.tension, 0);
      EXPECT_GE(r.dissipation, 0);
      if (peak > 0 && r.stretch < 0) was_slack_again = true;
      peak = std::max(peak, r.tension);
    }
    EXPECT_TRUE(was_slack_again);
    EXPECT_GT(peak, 400);
    EXPECT_NEAR(w.energy() + w.works[0], before, 1e-3) << damping;
    EXPECT_GE(w.works[0], damping > 0 ? 1 : 0);
  }
}

// Hauling in with one end held by its weight: the winch's work is the energy gained.
TEST(Rope, WinchPowerBalances) {
  constexpr double k = 1e4;
  Atwood w(2, 2, k, 20, Atwood::path(0, 0) - 2 * kG / k);
  w.winch_rate = -0.4;
  realize_at(w.system, w.state, 1e-12);
  realize_at(w.system, w.state, 0);
  const double before = w.energy();
  w.run(0, 1, 1e-4);
  EXPECT_NEAR(w.energy() + w.works[0] - w.works[1], before, 1e-7);
  EXPECT_NEAR(w.a.getOneQ(w.state, 0), 0.2, 0.01);  // each end rises half of what is hauled in
}

// k = EA / (f L): 30 % of a 40 m rope stretches.
TEST(Rope, OnlyTheElasticPartStretches) {
  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter(system);
  SimTK::GeneralForceSubsystem forces(system);
  SimTK::MobilizedBody::Free body(matter.Ground(),
                                  SimTK::MassProperties(1, SimTK::Vec3(0), SimTK::Inertia(1)));
  RopeSpec spec;
  spec.sheave_body = matter.Ground();
  spec.sheave_center = SimTK::Vec3(0, 0, 30);
  spec.sheave_radius = 1;
  spec.body_a = matter.Ground();
  spec.station_a = SimTK::Vec3(-1, 0, 10);
  spec.body_b = body;
  spec.axial_stiffness = 2.5e8;
  spec.elastic_fraction = 0.3;
  auto* rope = new Rope(spec, [](const SimTK::State&) { return FreeLength{40, 0}; });
  SimTK::Force::Custom(forces, rope);
  SimTK::State state = system.realizeTopology();
  const double straight = 20 + M_PI;
  body.setQToFitTranslation(state, SimTK::Vec3(1, 0, 30 - (40.01 - straight)));
  system.realize(state, SimTK::Stage::Velocity);
  EXPECT_NEAR(rope->evaluate(state).tension, 2.5e8 / (0.3 * 40) * 0.01, 1e-3);
}

}  // namespace
}  // namespace dipper::mbs
