// Crowd force, rope tension and swing torque of a whole cycle against Lagrange's equations of the
// shovel by hand: saddle angle theta and crowd c in the plane of the boom, swing psi about z.
#include "machine/sheave_path.hpp"
#include "tests/mbs/shovel_fixture.hpp"

namespace dipper::mbs {
namespace {

constexpr double kG = 9.81;

/// A body on the handle: its mass centre in the handle's axes, from the saddle at crowd 0, and how
/// far its own axes are turned up from the handle's.
struct Part {
  double mass, a, b, turn;
  Vector3d inertia;
};

struct Planar {
  double theta, theta1, theta2, c, c1, c2, psi1, psi2;  // 1, 2: rates
};

/// What the drives have to give, and the moments of the rope about the saddle.
struct Forces {
  double crowd, rope_moment, swing;
};

/// With X = s + (a + c) cos theta - b sin theta, a body's distance from the swing axis, and J its
/// moment of inertia about the vertical, the kinetic energy is
/// 1/2 sum m [(c' - theta' b)^2 + theta'^2 (a + c)^2] + I theta'^2 + psi'^2 (m X^2 + J).
Forces by_hand(const std::vector<Part>& parts, const machine::MachineData& m, const Planar& p) {
  const double sin = std::sin(p.theta), cos = std::cos(p.theta), s = m.saddle.position.x();
  Forces f{0, m.saddle.inertia * p.theta2 + m.saddle.damping * p.theta1, 0};
  double about_z = m.house.swing_inertia + m.boom.sheave_mass * std::pow(m.boom.point.x(), 2) +
                   m.boom.sheave_inertia + m.saddle.mass * s * s + m.saddle.inertia;
  for (const Part& q : parts) {
    const double out = q.a + p.c, X = s + out * cos - q.b * sin;
    const double dX_dtheta = -out * sin - q.b * cos, dX_dc = cos;
    const double pitch = p.theta + q.turn;
    const double J =
        q.inertia.x() * std::pow(std::sin(pitch), 2) + q.inertia.z() * std::pow(std::cos(pitch), 2);
    const double dJ = (q.inertia.x() - q.inertia.z()) * std::sin(2 * pitch);
    f.crowd += q.mass * (p.c2 - p.theta2 * q.b - p.theta1 * p.theta1 * out + kG * sin -
                         p.psi1 * p.psi1 * X * dX_dc);
    f.rope_moment += (q.inertia.y() + q.mass * (out * out + q.b * q.b)) * p.theta2 +
                     q.mass * (-p.c2 * q.b + 2 * p.theta1 * p.c1 * out +
                               kG * (out * cos - q.b * sin) - p.psi1 * p.psi1 * X * dX_dtheta) -
                     0.5 * p.psi1 * p.psi1 * dJ;
    about_z += q.mass * X * X + J;
    f.swing += p.psi1 * (2 * q.mass * X * (dX_dtheta * p.theta1 + dX_dc * p.c1) + dJ * p.theta1);
  }
  f.swing += about_z * p.psi2;
  return f;
}

std::vector<Part> parts_of(const machine::MachineData& m, double rake) {
  const double reach = m.handle.reach_at_zero_crowd;
  const auto on_dipper = [&](double mass, const Vector3d& p_B, const Vector3d& inertia) {
    const Vector3d d = p_B - m.dipper.handle_end;
    return Part{mass, reach + d.x() * std::cos(rake) - d.z() * std::sin(rake),
                d.x() * std::sin(rake) + d.z() * std::cos(rake), rake, inertia};
  };
  return {{m.handle.mass, reach + m.handle.mass_center, 0, 0, m.handle.inertia},
          on_dipper(m.dipper.mass, m.dipper.mass_center, m.dipper.inertia),
          on_dipper(m.door.mass, m.door.hinge + m.door.mass_center, m.door.inertia)};
}

class InverseDynamics : public ShovelTest {
 protected:
  /// At a time, from three windows of a millisecond: what the channels say and what they should.
  struct Compared {
    Forces said, should, without_swing;
  };

  Compared compare_at(Shovel& shovel, const machine::Motion& m, std::int64_t t_ms) {
    double rate[3];
    std::map<std::string, double> c;
    for (int k = 0; k < 3; ++k) {
      auto now = named(shovel, shovel.step({(t_ms + k) * kMillisecond, no_rock}));
      rate[k] = now["saddle_rate"];
      if (k == 1) c = now;
    }
    const machine::DriveState d = m.at(1e-3 * static_cast<double>(t_ms + 1));
    Planar p{
        c["saddle_pitch"],    rate[1],      (rate[2] - rate[0]) / 2e-3, c["crowd"], d.rate.crowd,
        d.acceleration.crowd, d.rate.swing, d.acceleration.swing};
    // The ropes' pull along the handle and about the saddle.
    const machine::ShovelKinematics k(machine, Pose{}, rake);
    const machine::Drives flat{d.position.hoist, d.position.crowd, 0, 0};
    const Vector3d bail = k.pose(flat, p.theta).X_WB * machine.dipper.bail;
    const Vector3d to_bail = bail - machine.boom.point,
                   to_drum = machine.rope.drum - machine.boom.point,
                   arm = bail - machine.saddle.position;
    const auto rope = machine::sheave_path({to_drum.x(), to_drum.z()}, {to_bail.x(), to_bail.z()},
                                           machine.boom.sheave_radius)
                          .toward_b;
    const double tension = c["rope_tension_left"] + c["rope_tension_right"];
    const double along = tension * (rope.x() * std::cos(p.theta) + rope.y() * std::sin(p.theta));
    const std::vector<Part> parts = parts_of(machine, rake);
    Compared out;
    out.said = {c["crowd_force"] + along, tension * (arm.x() * rope.y() - arm.z() * rope.x()),
                c["swing_torque"]};
    out.should = by_hand(parts, machine, p);
    p.psi1 = 0;
    out.without_swing = by_hand(parts, machine, p);
    return out;
  }
};

// Until the door opens; the machine's weight is 0.84 MN, its moment about the saddle up to 9 MN m.
TEST_F(InverseDynamics, OfACycleIsLagrangesByHand) {
  const machine::Motion m = motion(
      "0,-2,0,0,0\n2,-2.5,0.5,0,0\n4,-5,2.4,3,0\n6,-7.5,2.6,25,0\n8,-9.5,1.5,60,0\n10,-10,1,80,0\n"
      "12,-10,1,80,0\n");
  Shovel shovel(machine, m, Pose{}, rake, 1'000'000);
  double centrifugal_crowd = 0, centrifugal_rope = 0, coriolis = 0;
  for (std::int64_t t_ms = 200; t_ms < 11'500; t_ms += 300) {
    shovel.step({t_ms * kMillisecond - kMillisecond, no_rock});
    const Compared c = compare_at(shovel, m, t_ms);
    EXPECT_NEAR(c.said.crowd, c.should.crowd, 30) << t_ms;
    EXPECT_NEAR(c.said.rope_moment, c.should.rope_moment, 500) << t_ms;
    EXPECT_NEAR(c.said.swing, c.should.swing, 1e-6 * 1e8) << t_ms;
    centrifugal_crowd =
        std::max(centrifugal_crowd, std::abs(c.should.crowd - c.without_swing.crowd));
    centrifugal_rope =
        std::max(centrifugal_rope, std::abs(c.should.rope_moment - c.without_swing.rope_moment));
    coriolis = std::max(coriolis, std::abs(c.should.swing - c.without_swing.swing));
  }
  // What the swing adds is far above what the test lets pass.
  EXPECT_GT(centrifugal_crowd, 3e4);
  EXPECT_GT(centrifugal_rope, 3e4);
  EXPECT_GT(coriolis, 1e5);
}

}  // namespace
}  // namespace dipper::mbs
