// Sliding, rolling and rolling friction through LIGGGHTS with the generated tables: Eqs. 7 and 8 of
// Svanberg et al. 2021 for sphere and rock on the ground, on the dipper's plate, and on a held
// sphere (over distances that are nothing beside its radius). g = I/(m r^2): 2/5 for a sphere.
#include "tests/coupler/deck/two_body.hpp"

namespace dipper::two_body {
namespace {

constexpr double kGravity = 9.81;

struct Bed {
  const char* name;
  Kind a, b;
  int type;         ///< of the ground
  double gyration;  ///< of a rock
};
constexpr Bed kBeds[] = {{"sphere_on_ground", sphere, wall, ground, 0.4},
                         {"sphere_on_plate", sphere, wall, dipper, 0.4},
                         {"rock_on_ground", rock, wall, ground, 0.4},
                         {"hollow_rock_on_plate", rock, wall, dipper, 2.0 / 3},
                         {"sphere_on_sphere", sphere, held, ground, 0.4},
                         {"rock_on_sphere", rock, held, ground, 0.4}};

class Rolling : public testing::TestWithParam<Bed> {
 protected:
  Rolling() : a(body(c, GetParam().a, GetParam().gyration)) {
    if (GetParam().b == held) below = body(c, held);
    // Stiff: a contact that has long come to rest when it starts to roll.
    c.contact.normal_scale = 5;
    const cases::ContactCase& k = c.contact;
    const bool on_plate = GetParam().type == dipper;
    mu = GetParam().b == held ? (a.kind == rock ? k.friction_sphere_rock : k.friction_sphere_sphere)
                              : (on_plate ? k.friction_dipper : k.friction_ground);
    rolling = a.kind == rock && GetParam().b == wall ? 0
              : GetParam().b == held || on_plate     ? k.rolling_friction_sphere
                                                     : k.rolling_friction_ground;
    w = std::sqrt(normal_stiffness(c, a, b()) / a.mass);
    s.timestep = 0.02 / w;
    s.ground_type = GetParam().type;
  }
  const Body* b() const { return GetParam().b == held ? &below : nullptr; }
  /// A rests under gravity tilted by the angle.
  void tilt(double angle) {
    s.gx = kGravity * std::sin(angle);
    s.gz = -kGravity * std::cos(angle);
    s.gap = s.gz / (w * w);
  }
  /// The torque of rolling friction over r F_n. Eq. 8 takes the sphere's own radius; where a rock
  /// rolls on a sphere of another size, that is less than its own.
  double resistance() const {
    return a.kind == rock ? rolling * below.contact / a.contact : rolling;
  }
  cases::Case c = paper_case();
  Body a, below;
  double mu = 0, rolling = 0, w = 0;
  Start s;
};

TEST_P(Rolling, SlidingTurnsToRolling) {
  // While it slides: v' = -mu G, r w' = (mu - mu_r) G/g. Without mu_r, and g = 2/5: v = 5/7 v_0 at
  // t = 2 v_0/(7 mu G).
  // No tangential damping: it acts in the very first step (two_body_test's Grazing).
  c.contact.tangential_damping = 0;
  tilt(0);
  const double g = a.gyration, v0 = b() == nullptr ? 1 : 0.1;
  s.vx = v0;
  const double t_roll = v0 / (kGravity * (mu + (mu - resistance()) / g));
  const double v_roll = v0 - mu * kGravity * t_roll;
  if (rolling == 0 && g == 0.4) {
    EXPECT_NEAR(v_roll / v0, 5.0 / 7, 1e-12);
  }
  s.steps = static_cast<int>(1.2 * t_roll / s.timestep);
  const Record r = run(c, a, b(), s);
  std::size_t i = 0;
  while (i + 1 < r.t.size() && r.vx[i] > r.wy[i] * a.contact) ++i;
  EXPECT_NEAR(r.t[i] / t_roll, 1, 0.01);
  EXPECT_NEAR(r.vx[i] / v_roll, 1, 0.005);
}

TEST_P(Rolling, DownAnInclineByEq8) {
  // a = G (sin - mu_r cos)/(1 + g); it starts where tan = mu_r.
  const double onset = std::atan(resistance());
  const double T = b() == nullptr ? 0.1 : 0.05;
  s.steps = static_cast<int>(T / s.timestep);
  s.every = 10;
  const auto rolled = [&](double angle) {
    tilt(angle);
    const Record r = run(c, a, b(), s);
    return r.x.back() - r.x.front();
  };
  const auto known = [&](double angle) {
    const double acceleration =
        kGravity * (std::sin(angle) - resistance() * std::cos(angle)) / (1 + a.gyration);
    return acceleration * T * T / 2;
  };
  const double steep = onset + 0.1, above = 1.05 * onset, below_it = 0.95 * onset;
  EXPECT_NEAR(rolled(steep) / known(steep), 1, 0.02);
  if (onset > 0) {
    EXPECT_GT(rolled(above), 0.8 * known(above));
    EXPECT_LT(rolled(below_it), 0.1 * known(above));
  }
}

INSTANTIATE_TEST_SUITE_P(Of, Rolling, testing::ValuesIn(kBeds),
                         [](const auto& p) { return std::string(p.param.name); });

}  // namespace
}  // namespace dipper::two_body
