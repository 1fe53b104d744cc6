// Impacts through LIGGGHTS with the generated tables, against closed forms, one an equation of
// Svanberg et al. 2021: for sphere and sphere, sphere and rock, rock and rock, sphere and wall,
// rock and wall. A rock is a multisphere whose mass is not its spheres'.
#include "tests/coupler/deck/two_body.hpp"

#include <algorithm>

namespace dipper::two_body {
namespace {

struct Pair {
  const char* name;
  Kind a, b;
};
constexpr Pair kPairs[] = {{"sphere_sphere", sphere, sphere},
                           {"sphere_rock", sphere, rock},
                           {"rock_rock", rock, rock},
                           {"sphere_wall", sphere, wall},
                           {"rock_wall", rock, wall}};

class Impact : public testing::TestWithParam<Pair> {
 protected:
  cases::Case c = paper_case();
  Body a, b_body;
  const Body* b = nullptr;
  double kn = 0, m = 0, w = 0;
  void set_up() {
    a = body(c, GetParam().a);
    if (GetParam().b != wall) {
      b_body = body(c, GetParam().b);
      b = &b_body;
    }
    kn = normal_stiffness(c, a, b);
    m = effective_mass(a, b);
    w = std::sqrt(kn / m);
  }
};

/// The oscillator m x'' + c x' + K x = 0, cut where the force would turn attractive (Schwager and
/// Poeschel 2007, Granular Matter 9:465): c = D 2 sqrt(m K).
struct Oscillator {
  double D, w;
  double root() const { return std::sqrt(1 - D * D); }
  double duration() const { return 2 * std::acos(D) / (w * root()); }
  double restitution() const { return std::exp(-2 * D * std::acos(D) / root()); }
  double overlap(double v) const { return v / w * std::exp(-D * std::acos(D) / root()); }
};

TEST_P(Impact, HeadOnIsTheDampedOscillatorOfEqs3To6) {
  for (const double D : {0.05, 0.9}) {
    c.contact.normal_damping = D;
    set_up();
    const Oscillator known{D, w};
    Start s;
    s.vz = -1;
    s.timestep = 1 / (1000 * w);
    s.steps = 4500;
    s.gap = 5 * s.timestep;
    const Record r = run(c, a, b, s);
    std::size_t first = 0, last = r.vz.size() - 1;
    while (first + 1 < r.vz.size() && r.vz[first + 1] == r.vz[0]) ++first;
    while (last > 0 && r.vz[last - 1] == r.vz.back()) --last;
    // The change of A's velocity is m/m_A of the relative one's.
    const double e = (r.vz.back() + 1) * a.mass / m - 1;
    EXPECT_NEAR(e, known.restitution(), 0.003) << D;
    EXPECT_NEAR((r.t[last] - r.t[first]) / known.duration(), 1, 0.01) << D;
    if (b == nullptr) {
      const double low = *std::min_element(r.z.begin(), r.z.end());
      EXPECT_NEAR((a.contact - low) / known.overlap(1), 1, 0.005) << D;
    }
  }
}

TEST_P(Impact, StickingIsTheTangentialOscillator) {
  // While it sticks the contact is linear too: the slip u obeys m_t u'' + c_t u' + K_t u = 0 with
  // m_t = m g/(1 + g), g = I/(m r^2) = 2/5. Here K_t = C_tan K_n and c_t = D_t 2 sqrt(m K_t).
  c.contact.normal_damping = 0.1;
  c.contact.friction_sphere_sphere = c.contact.friction_sphere_rock = 5;
  c.contact.friction_rock_rock = c.contact.friction_ground = 5;
  c.contact.rolling_friction_sphere = c.contact.rolling_friction_ground = 0;
  for (const double D : {0.05, 0.75}) {
    c.contact.tangential_damping = D;
    set_up();
    const double kt = c.contact.tangential_scale * kn, mt = m * 2 / 7;
    const double w0 = std::sqrt(kt / mt), zeta = D * std::sqrt(m / mt);
    Start s;
    s.vz = -0.1;
    s.vx = 0.02;
    s.timestep = 1 / (2000 * w);
    s.steps = 6000;
    s.gap = 0.1 * 2 * s.timestep;
    const Record r = run(c, a, b, s);
    std::size_t first = 0;
    while (first + 1 < r.vz.size() && r.vz[first + 1] == r.vz[0]) ++first;
    double worst = 0;
    // Up to the deepest point; towards the end the contact slides, whatever mu is.
    for (std::size_t i = first; i < r.t.size() && r.t[i] - r.t[first] < M_PI / 2 / w; ++i) {
      const double t = r.t[i] - r.t[first];
      double known = 0;
      if (zeta < 1) {
        const double wd = w0 * std::sqrt(1 - zeta * zeta);
        known = std::exp(-zeta * w0 * t) * (std::cos(wd * t) - zeta * w0 / wd * std::sin(wd * t));
      } else {
        const double h = w0 * std::sqrt(zeta * zeta - 1), p = -zeta * w0 + h, q = -zeta * w0 - h;
        known = (p * std::exp(p * t) - q * std::exp(q * t)) / (p - q);
      }
      // A's share of the slip's change is m/m_A.
      const double slip = s.vx + (r.vx[i] - r.wy[i] * a.contact - s.vx) * a.mass / m;
      worst = std::max(worst, std::abs(slip / s.vx - known));
    }
    EXPECT_LT(worst, 0.01) << D;
  }
}

TEST_P(Impact, SlidingTakesMuTimesTheNormalImpulse) {
  // Eq. 7 over a whole impact: the tangential impulse is mu (1 + e) m v_n. Without tangential
  // damping (see TangentialDampingIsNotBounded), and with little normal damping, so that the force
  // grows from zero and the spring has no lag behind it.
  c.contact.tangential_damping = 0;
  c.contact.normal_damping = 0.02;
  c.contact.rolling_friction_sphere = c.contact.rolling_friction_ground = 0;
  const cases::ContactCase k = c.contact;
  std::map<int, double> partners{{ground, k.friction_ground}};
  if (GetParam().b == wall) {
    partners = {{ground, k.friction_ground}, {dipper, k.friction_dipper}, {truck, 0.7}, {sides, 0}};
    c.contact.friction_truck = 0.7;
  } else {
    partners[ground] = GetParam().b == sphere   ? k.friction_sphere_sphere
                       : GetParam().a == sphere ? k.friction_sphere_rock
                                                : k.friction_rock_rock;
  }
  for (const auto& [type, mu] : partners) {
    set_up();
    Start s;
    s.vz = -0.002;  // slow: the normal must not turn while they slide
    s.vx = 0.06;
    s.timestep = 1 / (500 * w);
    s.steps = 2000;
    s.gap = 1e-8;
    s.ground_type = type;
    const Record r = run(c, a, b, s);
    const double e = Oscillator{c.contact.normal_damping, w}.restitution();
    const double impulse = mu * (1 + e) * m * 0.002;
    EXPECT_NEAR((s.vx - r.vx.back()) * a.mass, impulse, 0.01 * impulse + 1e-9) << type;
    EXPECT_NEAR(r.wy.back() * a.gyration * a.mass * a.contact, impulse, 0.01 * impulse + 1e-9)
        << type;
  }
}

/// Tangential over normal impulse of a sphere that hits the ground obliquely, by the law
/// as LIGGGHTS has it: the spring is cut at mu F_n, and the damper acts, unbounded, until it is.
double impulse_ratio(const cases::ContactCase& k, double vn, double vt) {
  const double dt = 1e-5, cn = 2 * k.normal_damping;  // m = K_n = 1
  const double kt = k.tangential_scale, ct = 2 * k.tangential_damping * std::sqrt(kt);
  double x = 0, v = vn, slip = vt, spring = 0, normal = 0, tangential = 0;
  while (x >= 0) {
    v -= dt * std::max(0.0, x + cn * v);
    x += dt * v;
    const double fn = std::max(0.0, x + cn * v);
    spring += dt * slip;
    const bool slides = kt * std::abs(spring) > k.friction_ground * fn;
    if (slides) spring = std::copysign(k.friction_ground * fn / kt, spring);
    const double ft = kt * spring + (slides ? 0 : ct * slip);
    slip -= 3.5 * dt * ft;
    normal += dt * fn;
    tangential += dt * ft;
  }
  return tangential / normal;
}

TEST(Grazing, TangentialDampingIsNotBounded) {
  // What differs from the paper, where Eq. 7 bounds the whole tangential force: at a grazing first
  // touch the damper alone exceeds mu F_n. Rock that already slides is bounded (rolling_test).
  cases::Case c = paper_case();
  c.contact.rolling_friction_ground = 0;
  const Body a = body(c, sphere);
  const double w = std::sqrt(normal_stiffness(c, a, nullptr) / a.mass);
  for (const auto& [vt, excess] : std::map<double, double>{{3, 0.948}, {10, 2.704}}) {
    Start s;
    s.vz = -0.1;
    s.vx = 0.1 * vt;
    s.timestep = 1 / (2000 * w);
    s.steps = 8000;
    const Record r = run(c, a, nullptr, s);
    const double ratio = (s.vx - r.vx.back()) / (r.vz.back() + 0.1);
    EXPECT_NEAR(ratio / impulse_ratio(c.contact, 1, vt), 1, 0.01) << vt;
    EXPECT_NEAR(ratio / c.contact.friction_ground, excess, 0.02 * excess) << vt;
  }
}

INSTANTIATE_TEST_SUITE_P(Of, Impact, testing::ValuesIn(kPairs),
                         [](const auto& p) { return std::string(p.param.name); });

}  // namespace
}  // namespace dipper::two_body
