// The rope of elements where its answers are known, and in the shovel beside the elastic one.
#include "mbs/segmented_rope.hpp"

#include <cmath>
#include <cstdio>

#include "machine/sheave_path.hpp"
#include "tests/mbs/runge_kutta.hpp"
#include "tests/mbs/shovel_fixture.hpp"

namespace dipper::mbs {
namespace {

using Eigen::Vector2d;

constexpr double kG = 9.81;
const Vector2d kDown(0, -kG);

SegmentedRopeSpec spec(double stiffness, double mass_per_length, double length) {
  SegmentedRopeSpec s;
  s.drum = {-20, -12};
  s.radius = 1.2;
  s.law.axial_stiffness = stiffness;
  s.mass_per_length = mass_per_length;
  s.over = machine::sheave_path(s.drum, {s.radius, -10}, s.radius).length - 10;
  s.longest = s.shortest = length;
  return s;
}

double path(const SegmentedRopeSpec& s, const Vector2d& end) {
  return machine::sheave_path(s.drum, end, s.radius).length;
}

// From the lower end up, s of unstretched rope on, with H and V the tension there and w the weight:
// x = H s / EA + H/w [asinh((V + w s)/H) - asinh(V/H)], z likewise (Irvine 1981, Cable Structures).
TEST(SegmentedRope, HangsAsAnElasticCatenary) {
  const Vector2d end(16, -9);
  SegmentedRopeSpec s = spec(2e6, 22, 0);
  const double length = s.longest = s.shortest = path(s, end) - 0.06;
  const SegmentedRope rope(s);
  const auto nodes = rope.settled(end, length, kDown);
  const auto now = rope.at(nodes, end, Vector2d::Zero(), {length, 0}, kDown);
  const int n = s.elements;
  const double l = 0.9 * (length - s.over) / n, w = rope.node_mass() * kG / l;
  const double stiffness = n * s.law.axial_stiffness / length * l;  // of an element, N a strain
  // An element has the tension of its middle.
  const double H = -now.pull.x(), V = now.pull.y() - 0.5 * w * l;
  double sag = 0;
  for (int i = n - 2; i >= 0; --i) {
    const double u = (n - 1 - i) * l, above = V + w * u;
    const double x = H * u / stiffness + H / w * (std::asinh(above / H) - std::asinh(V / H));
    const double z =
        u / stiffness * (V + 0.5 * w * u) + (std::hypot(H, above) - std::hypot(H, V)) / w;
    const Vector2d hand = end + Vector2d(-x, z), node = nodes.segment<2>(2 * i);
    EXPECT_LT((node - hand).norm(), 1e-3) << i;
    const Vector2d chord = Vector2d(nodes.segment<2>(0)) - end, off = node - end;
    sag = std::max(sag, std::abs(chord.x() * off.y() - chord.y() * off.x()) / chord.norm());
  }
  EXPECT_GT(sag, 0.3) << "it does hang";
  EXPECT_LT(now.rates.norm(), 1e-4);
}

/// A mass on the end of a rope of constant length, free to move up and down.
struct Hanging {
  SegmentedRopeSpec s;
  double mass, length;
  SegmentedRope rope;
  SegmentedRope::Numbers y;  ///< z, z', rope paid out and its rate, dissipated, nodes
  double counter = 0;        ///< kg on the drum's side, the sheave's inertia in it
  double counterweight = 0;  ///< N

  Hanging(const SegmentedRopeSpec& spec, double m, double at, double stretch)
      : s(spec), mass(m), length(path(s, {s.radius, at}) - stretch), rope(s) {
    y.resize(5 + rope.size());
    y << at, 0, 0, 0, 0, rope.settled({s.radius, at}, length, kDown);
  }
  SegmentedRope::Now now(const SegmentedRope::Numbers& at) const {
    return rope.at(at.tail(rope.size()), {s.radius, at[0]}, {0, at[1]}, {length + at[2], at[3]},
                   kDown);
  }
  void step(double h) {
    runge_kutta_step(y, 0, h, [&](const SegmentedRope::Numbers& at, double) {
      const auto n = now(at);
      SegmentedRope::Numbers dy(at.size());
      const double pays_out = counter > 0 ? (n.state.winch_pull - counterweight) / counter : 0;
      dy << at[1], n.pull.y() / mass - kG, at[3], pays_out, n.state.dissipation, n.rates;
      return dy;
    });
  }
  double energy() const {
    const auto n = now(y);
    return n.kinetic + n.potential + mass * (0.5 * y[1] * y[1] + kG * y[0]) +
           0.5 * counter * y[3] * y[3] + counterweight * y[2] + y[4];
  }
};

// 2 kg on the rope against 1 kg, over a disc of 1 kg: 2.8029 m/s^2, 14.014 and 12.613 N.
TEST(SegmentedRope, AtwoodWithTheSheavesInertia) {
  SegmentedRopeSpec s = spec(4e4, 1e-4, 40);
  s.law.damping = 20;
  Hanging w(s, 2, -15, 14.014 / (4e4 / 40));
  w.counter = 1 + 0.5;
  w.counterweight = 1 * kG;
  const double before = w.energy();
  for (int i = 0; i < 20'000; ++i) w.step(0.5 * w.rope.longest_step());
  const double t = 20'000 * 0.5 * w.rope.longest_step();
  const auto now = w.now(w.y);
  EXPECT_NEAR(w.y[3] / t, 2.8029, 3e-3);
  EXPECT_NEAR(now.pull.y(), 14.014, 0.03);
  EXPECT_NEAR(w.counterweight + (w.counter - 0.5) * 2.8029, 12.613, 1e-3);
  EXPECT_NEAR(w.energy(), before, 1e-4);
}

// A dipper's half thrown up from its rest: slack, and snapped taut again, and again.
TEST(SegmentedRope, SlackAndSnapKeepTheEnergyBooks) {
  SegmentedRopeSpec s = spec(2.5e8, 22, 38);
  s.law.elastic_fraction = 0.3;
  s.law.damping = 1e5;
  Hanging w(s, 43'000, -12, 43'000 * kG / (2.5e8 / (0.3 * 38)));
  w.y[1] = 2;
  const double before = w.energy(), thrown = 0.5 * w.mass * 4;
  const double h = 0.1 * w.rope.longest_step();
  int snaps = 0;
  bool slack = false;
  double peak = 0, worst = 0;
  for (double t = 0; t < 1.5; t += h) {
    w.step(h);
    const auto now = w.now(w.y);
    ASSERT_GE(now.state.tension, 0);
    if (now.pull.norm() == 0) slack = true;
    if (slack && now.pull.norm() > 0.5 * w.mass * kG) {
      ++snaps;
      slack = false;
    }
    peak = std::max(peak, now.pull.norm());
    worst = std::max(worst, std::abs(w.energy() - before));
  }
  EXPECT_LT(worst, 1e-3 * thrown);
  std::printf("snaps %d, peak %.3g, books %.3g J of %.3g, damped %.3g\n", snaps, peak, worst,
              thrown, w.y[4]);
  EXPECT_GE(snaps, 2);
  EXPECT_GT(peak, 2 * w.mass * kG);
  EXPECT_GT(w.y[4], 0.05 * thrown) << "the dampers took some";
}

class SegmentedShovel : public ShovelTest {
 protected:
  Shovel shovel(bool segmented, const machine::Motion& motion, machine::DriveMode mode) {
    machine.rope.segmented = segmented;
    return Shovel(machine, motion, Pose{}, rake, kLongestSubstep_ns, mode);
  }
};

TEST_F(SegmentedShovel, DigsAsWithElasticRopes) {
  for (const auto mode : {machine::DriveMode::prescribed, machine::DriveMode::limited}) {
    Shovel elastic = shovel(false, quick(), mode), segmented = shovel(true, quick(), mode);
    double peak[2] = {0, 0}, traded = 0;
    for (int i = 1; i <= 2500; ++i) {
      const double t = 4e-3 * i;
      const std::vector<Wrench> dig = {
          Wrench{Vector3d(0, -4e5, 0),
                 Vector3d(-4e5 * std::sin(t / 4), 0, -6e5 + 3e5 * std::sin(7 * t))},
          Wrench{}};
      auto a = named(elastic, elastic.step({4 * i * kMillisecond, dig}));
      auto b = named(segmented, segmented.step({4 * i * kMillisecond, dig}));
      peak[0] = std::max(peak[0], a["rope_tension_left"]);
      peak[1] = std::max(peak[1], b["rope_tension_left"]);
      traded = std::max(traded, std::abs(b["drive_work"]));
      ASSERT_LT(std::abs(b["energy_residual"]), 2e-6 * std::max(traded, 1e6)) << t;
    }
    EXPECT_NEAR(peak[1], peak[0], 0.02 * peak[0]);
    EXPECT_NE(peak[1], peak[0]);
    std::printf("peak tension %.6g, %.6g N\n", peak[0], peak[1]);
  }
}

TEST_F(SegmentedShovel, BeginsAtRestAndSavesEveryNode) {
  Shovel a = shovel(true, still(), machine::DriveMode::limited);
  const Vector3d start = a.state(0).bodies[0].X_WB.p;
  for (int i = 1; i <= 100; ++i) a.step({2 * i * kMillisecond, no_rock});
  EXPECT_LT((a.state(0).bodies[0].X_WB.p - start).norm(), 1e-8);
  const std::vector<Wrench> push = {Wrench{Vector3d::Zero(), Vector3d(-1e5, 0, 2e5)}, Wrench{}};
  a.step({300 * kMillisecond, push});
  const auto file = std::filesystem::path(testing::TempDir()) / "segmented.bin";
  a.save(file);
  Shovel b = shovel(true, still(), machine::DriveMode::limited);
  b.load(file);
  EXPECT_EQ(a.step({340 * kMillisecond, push}).channels,
            b.step({340 * kMillisecond, push}).channels);
  Shovel elastic = shovel(false, still(), machine::DriveMode::limited);
  EXPECT_THROW(elastic.load(file), std::runtime_error);
}

}  // namespace
}  // namespace dipper::mbs
