// Head-on impact through LIGGGHTS against the damped oscillator m x'' + c x' + K x = 0, cut where
// the force would turn attractive (Schwager and Poeschel 2007, Granular Matter 9:465): with D =
// c/(2 sqrt(m K)) and w = sqrt(K/m), the contact lasts 2 acos(D)/(w sqrt(1 - D^2)) and the
// restitution is exp(-2 D acos(D)/sqrt(1 - D^2)).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "coupler/deck/contact_table.hpp"
#include "tests/deck/liggghts_run.hpp"
#include "tests/deck/quick_case.hpp"

namespace dipper {
namespace {

struct Impact {
  double duration_s = 0;
  double v_after = 0;  ///< of the first sphere, which came with -1 m/s
};

Impact run_impact(const Case& c, bool wall) {
  const ContactTable t = contact_table(c);
  const int other = wall ? atom_types(c).ground() - 1 : 0;
  const double kn = t.kn(0, other), meff = t.meff_kg(0, other);
  const double step = std::sqrt(meff / kn) / 1000;
  const auto out = fresh_folder("two_body");
  EXPECT_EQ(
      run_liggghts(
          "dem_in/bench_impact.in",
          fmt::format("-var wall {} -var radius {} -var density {} -var kn {} -var gamman {} -var "
                      "timestep {} -var steps 4500",
                      wall ? 1 : 0, rock_classes(c)[0].radius_m, c.rock.density_kg_m3, kn,
                      t.gamman(0, other), step),
          1, out),
      0);
  std::ifstream in(out / "impact.txt");
  std::string title;
  std::getline(in, title);
  std::vector<double> time, v;
  for (double a = 0, b = 0; in >> a >> b;) {
    time.push_back(a);
    v.push_back(b);
  }
  EXPECT_GT(v.size(), 4000U) << read_text(out / "screen.txt");
  std::size_t first = 0, last = v.size() - 1;
  while (first + 1 < v.size() && v[first + 1] == v[0]) ++first;
  while (last > 0 && v[last - 1] == v.back()) --last;
  return {time[last] - time[first], v.back()};
}

class TwoBody : public testing::TestWithParam<double> {};

TEST_P(TwoBody, MatchesTheDampedOscillator) {
  Case c = quick_case();
  c.rock.coarse_graining = 1;
  c.contact.normal_scale = 0.05;
  c.contact.normal_damping = GetParam();
  const double D = GetParam(), root = std::sqrt(1 - D * D);
  const double e = std::exp(-2 * D * std::acos(D) / root);
  for (const bool wall : {false, true}) {
    const ContactTable t = contact_table(c);
    const int other = wall ? atom_types(c).ground() - 1 : 0;
    const double w = std::sqrt(t.kn(0, other) / t.meff_kg(0, other));
    const Impact got = run_impact(c, wall);
    // Equal spheres, the second at rest: the first keeps (1 - e)/2 of its velocity.
    EXPECT_NEAR(wall ? got.v_after : 1 + 2 * got.v_after, e, 0.003) << "wall " << wall;
    EXPECT_NEAR(got.duration_s * w * root / (2 * std::acos(D)), 1, 0.01) << "wall " << wall;
  }
}

INSTANTIATE_TEST_SUITE_P(Damping, TwoBody, testing::Values(0.05, 0.5, 0.9));

}  // namespace
}  // namespace dipper
