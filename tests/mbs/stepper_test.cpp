// The integrator on problems with published answers.
#include "tests/mbs/stepper.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace dipper::mbs {
namespace {

/// IFToMM benchmark A01: 1 kg on a massless 1 m rod, released horizontal, g = 9.81 m/s^2.
class Pendulum : public testing::Test {
 protected:
  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter{system};
  SimTK::GeneralForceSubsystem forces{system};
  SimTK::MobilizedBody::Pin rod;
  SimTK::State state;
  SimTK::Vector none;

  Pendulum() {
    SimTK::Force::UniformGravity(forces, matter, SimTK::Vec3(0, -9.81, 0));
    const SimTK::MassProperties bob(1, SimTK::Vec3(1, 0, 0),
                                    SimTK::Inertia::pointMassAt(SimTK::Vec3(1, 0, 0), 1));
    rod = SimTK::MobilizedBody::Pin(matter.Ground(), SimTK::Transform(), SimTK::Body::Rigid(bob),
                                    SimTK::Transform());
    state = system.realizeTopology();
    realize_at(system, state, 0);
  }

  void run(std::int64_t t0_ns, std::int64_t t1_ns, std::int64_t substep_ns) {
    advance(system, state, t0_ns, t1_ns, substep_ns, nullptr, none);
  }
  SimTK::Vec3 bob() const { return rod.findStationLocationInGround(state, SimTK::Vec3(1, 0, 0)); }
};

// Published: (0.2750874626, -0.9614192051) at 10 s, released from (1, 0).
TEST_F(Pendulum, PositionAfterTenSeconds) {
  for (int i = 0; i < 5000; ++i) run(i * 2'000'000LL, (i + 1) * 2'000'000LL, 2'000'000);
  EXPECT_NEAR(bob()[0], 0.2750874626, 2e-9);
  EXPECT_NEAR(bob()[1], -0.9614192051, 1e-9);
}

TEST_F(Pendulum, FourthOrder) {
  const auto after = [&](std::int64_t substep_ns) {
    SimTK::State s = state;
    advance(system, s, 0, 1'000'000'000, substep_ns, nullptr, none);
    return s.getQ()[0];
  };
  const double exact = after(1'000'000);
  const double ratio = std::abs((after(40'000'000) - exact) / (after(20'000'000) - exact));
  EXPECT_NEAR(std::log2(ratio), 4, 0.3);
}

// Period 2.367842 s, top speed sqrt(2 g) = 4.429447 m/s, tension at the bottom 3 m g = 29.43 N.
TEST_F(Pendulum, PeriodSpeedAndTension) {
  constexpr std::int64_t step = 1'000'000;
  double top_speed = 0, tension = 0, quarter = 0;
  for (std::int64_t i = 0; quarter == 0; ++i) {
    const double before = bob()[0];
    run(i * step, (i + 1) * step, step);
    top_speed = std::max(top_speed, std::abs(rod.getOneU(state, 0)));
    if (before > 0 && bob()[0] <= 0) {
      quarter = (static_cast<double>(i) - before / (bob()[0] - before)) * 1e-3;
      const SimTK::SpatialVec pivot = rod.findMobilizerReactionOnBodyAtMInGround(state);
      tension = pivot[1][1];
    }
  }
  EXPECT_NEAR(4 * quarter, 2.367842, 2e-6);
  EXPECT_NEAR(top_speed, 4.429447, 1e-5);
  EXPECT_NEAR(tension, 29.43, 1e-3);
}

// The last stage must not see the prescribed acceleration that begins at the step's end.
TEST_F(Pendulum, SubstepsDivideTheWindow) {
  SimTK::State one = state, two = state;
  advance(system, one, 0, 5'000'000, 2'000'000, nullptr, none);  // three sub-steps
  EXPECT_DOUBLE_EQ(one.getTime(), 0.005);
  const double third = 5e-3 / 3;
  EXPECT_LT(third, 2e-3);
  advance(system, two, 0, 5'000'000, 5'000'000, nullptr, none);
  EXPECT_NEAR(one.getQ()[0], two.getQ()[0], 1e-12);
}

TEST_F(Pendulum, IntegratesPowers) {
  SimTK::Vector work(1, 0.0);
  const auto gravity_power = [&](const SimTK::State& s) {
    const SimTK::Vec3 v = rod.findStationVelocityInGround(s, SimTK::Vec3(1, 0, 0));
    return SimTK::Vector(1, -9.81 * v[1]);
  };
  advance(system, state, 0, 500'000'000, 2'000'000, gravity_power, work);
  EXPECT_NEAR(work[0], system.calcKineticEnergy(state), 1e-8);
  EXPECT_NEAR(work[0], -9.81 * bob()[1], 1e-8);
}

}  // namespace
}  // namespace dipper::mbs
