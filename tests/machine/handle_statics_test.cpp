// Forces that hold the dipper against virtual work, which knows no lever and no rope's direction.
#include "machine/handle_statics.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/angles.hpp"
#include "common/gravity.hpp"
#include "machine/machine_data.hpp"
#include "tests/places.hpp"

namespace dipper::machine {
namespace {

class HandleStaticsTest : public testing::Test {
 protected:
  MachineData machine = load_machine(test::source() / "mbs/bucyrus495.yaml");
  double rake = machine.dipper.base_rake;
  ShovelKinematics shovel{machine, Pose{}, rake};
  HandleStatics statics{machine, rake};

  Vector3d tip_B() const {
    return {machine.dipper.inside.x() + machine.dipper.tooth_reach, 0,
            -machine.dipper.inside.z() / 2};
  }

  /// Of all weights, J, with so much load.
  double potential(const Drives& d, double load_kg) const {
    const ShovelPose X = shovel.pose(d);
    const Vector3d out(std::cos(X.saddle), 0, std::sin(X.saddle));
    const auto of = [](double kg, const Vector3d& p) { return kg * kGravity_m_s2 * p.z(); };
    return of(machine.handle.mass,
              X.X_WB * machine.dipper.handle_end + machine.handle.mass_center * out) +
           of(machine.dipper.mass, X.X_WB * machine.dipper.mass_center) +
           of(machine.door.mass, X.X_WD * machine.door.mass_center) +
           of(load_kg, X.X_WB * Vector3d(machine.dipper.inside.x() / 2, 0, 0));
  }

  /// The forces that hold the weights, and a force on the teeth: what a metre of rope drawn in, or
  /// of handle pushed out, takes.
  Holding by_work(const Drives& at, double load_kg, double resistance_N) const {
    constexpr double kD = 1e-4;
    const Vector3d push = -resistance_N * (shovel.pose(at).X_WB.R * Vector3d::UnitX());
    const auto takes = [&](double hoist, double crowd) {
      const Drives to{at.hoist + hoist, at.crowd + crowd, 0, 0},
          from{at.hoist - hoist, at.crowd - crowd, 0, 0};
      const Vector3d moved = shovel.pose(to).X_WB * tip_B() - shovel.pose(from).X_WB * tip_B();
      return (potential(to, load_kg) - potential(from, load_kg) - push.dot(moved)) / (2 * kD);
    };
    return {-takes(kD, 0), takes(0, kD)};
  }
};

TEST_F(HandleStaticsTest, HoldsWhatVirtualWorkSays) {
  for (const Drives& at : {Drives{-1, -1.2, 0, 0}, {-4, 0.5, 0, 0}, {-9, 1.5, 0.4, 0}})
    for (const double load_kg : {0.0, 63e3})
      for (const double resistance_N : {0.0, 1.5e6}) {
        const HandlePlace p = statics.at(at);
        const Holding f = p.holding(p.empty() + load_kg * p.of_a_kg() +
                                    resistance_N * p.of_a_newton()),
                      expected = by_work({at.hoist, at.crowd, 0, 0}, load_kg, resistance_N);
        EXPECT_NEAR(f.hoist, expected.hoist, 30) << at.hoist;
        EXPECT_NEAR(f.crowd, expected.crowd, 30) << at.hoist;
        const Burden back = p.held(f);
        EXPECT_NEAR(p.holding(back).crowd, f.crowd, 1e-3);
      }
}

TEST_F(HandleStaticsTest, WeighsTheLoadApartFromTheResistanceOnTheTeeth) {
  for (const Drives& at : {Drives{-1, -1.2, 0, 0}, {-4, 0.5, 0, 0}, {-9, 1.5, 0, 0}}) {
    EXPECT_NEAR(statics.load_kg(at, by_work(at, 63e3, 0).hoist), 63e3, 10);
    for (const double resistance_N : {0.0, 1.5e6}) {
      const DigLoad l = statics.at(at).dig_load(by_work(at, 63e3, resistance_N));
      EXPECT_NEAR(l.load_kg, 63e3, 20) << at.hoist;
      EXPECT_NEAR(l.resistance_N, resistance_N, 200) << at.hoist;
    }
  }
}

TEST_F(HandleStaticsTest, RopesDoNotPush) {
  // A dipper whose teeth stand on the ground: the crowd alone is in balance along the handle.
  const HandlePlace p = statics.at({-1, -1.2, 0, 0});
  const Burden lifted{1e7, 2e6};
  EXPECT_EQ(p.holding(lifted).hoist, 0);
  EXPECT_EQ(p.holding(lifted).crowd, -2e6);
}

}  // namespace
}  // namespace dipper::machine
