#include "coupler/deck/contact_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "tests/coupler/deck/quick_case.hpp"

namespace dipper::deck {
namespace {

cases::Case paper_case() {
  cases::Case c = quick_case();
  c.rock.coarse_graining = 1;
  c.rock.density_kg_m3 = 3700;
  c.contact.normal_scale = 0.05;
  c.contact.rolling_friction_sphere = 0.05;
  return c;
}

TEST(ContactTable, RumpfInvertsToTheStrength) {
  // s = (1 - e)/e F/d^2: 1 kPa, porosity 0.4, 0.2 m: F = 1000 * 0.04 * 0.4/0.6 = 26.7 N.
  EXPECT_NEAR(pull_off_stress(1000, 0.4) * 0.2 * 0.2, 26.6667, 1e-3);
}

TEST(ContactTable, ThePapersTwoSpheres) {
  // Svanberg et al. 2021: two 200 mm spheres, K_n = 9.4e7 N/m, sqrt(m/K_n) = 4.1e-4 s.
  const cases::Case c = paper_case();
  const ContactTable t = contact_table(c);
  EXPECT_NEAR(t.kn(0, 0), 9.4e7, 0.03e7);
  EXPECT_NEAR(t.kn(0, 0), 0.05 * 45e9 / 1.2 * 0.1 / 2, 1);  // by hand: 93.75 MN/m
  EXPECT_NEAR(std::sqrt(rock_classes(c)[0].mass_kg / t.kn(0, 0)), 4.1e-4, 0.05e-4);
  EXPECT_NEAR(t.kt(0, 0) / t.kn(0, 0), 0.27, 1e-12);
}

TEST(ContactTable, DampingIsAShareOfCritical) {
  const ContactTable t = contact_table(paper_case());
  const double m = 3700 * M_PI / 6 * 0.008;  // 15.5 kg
  EXPECT_NEAR(t.meff_kg(0, 0), m / 2, 1e-9);
  // c = gamma m_eff; critical is 2 sqrt(m_eff K).
  EXPECT_NEAR(t.gamman(0, 0) * m / 2 / (2 * std::sqrt(m / 2 * t.kn(0, 0))), 0.9, 1e-12);
  EXPECT_NEAR(t.gammat(0, 0) * m / 2 / (2 * std::sqrt(m / 2 * t.kt(0, 0))), 0.75, 1e-12);
}

TEST(ContactTable, UnequalClassesAndWalls) {
  const cases::Case c = paper_case();
  const ContactTable t = contact_table(c);
  const double r1 = 0.1, r5 = 0.425, bulk = 45e9 / 1.2;
  EXPECT_NEAR(t.kn(0, 4), 0.05 * bulk * r1 * r5 / (r1 + r5), 1);
  const int wall = atom_types(c).dipper() - 1;
  EXPECT_NEAR(t.kn(4, wall), 0.05 * bulk * r5, 1);
  EXPECT_NEAR(t.meff_kg(4, wall), rock_classes(c)[4].mass_kg, 1e-9);
  EXPECT_TRUE(t.kn.isApprox(t.kn.transpose()));
}

TEST(ContactTable, CoarseGrainingKeepsTheShareOfCritical) {
  cases::Case c = paper_case();
  c.rock.coarse_graining = 2;
  const ContactTable one = contact_table(paper_case()), two = contact_table(c);
  EXPECT_NEAR(two.kn(0, 0) / one.kn(0, 0), 2, 1e-9);            // K ~ r
  EXPECT_NEAR(two.gamman(0, 0) / one.gamman(0, 0), 0.5, 1e-9);  // sqrt(K/m) ~ 1/r
}

TEST(ContactTable, FrictionOfTable2) {
  const cases::Case c = paper_case();
  const ContactTable t = contact_table(c);
  const AtomTypes a = atom_types(c);
  EXPECT_EQ(a.count(), 9);
  EXPECT_DOUBLE_EQ(t.friction(0, 0), 0.9);
  EXPECT_DOUBLE_EQ(t.friction(0, 3), 0.85);
  EXPECT_DOUBLE_EQ(t.friction(2, 3), 0.85);
  EXPECT_DOUBLE_EQ(t.friction(a.dipper() - 1, 0), 0.53);
  EXPECT_DOUBLE_EQ(t.friction(a.ground() - 1, 4), 0.9);
  EXPECT_DOUBLE_EQ(t.friction(a.truck() - 1, 4), 0.9);
  EXPECT_DOUBLE_EQ(t.friction(a.sides() - 1, 0), 0);
}

TEST(ContactTable, RollingTorqueIsTheSpheresRadiusTimesMuTimesForce) {
  const cases::Case c = paper_case();
  const ContactTable t = contact_table(c);
  const AtomTypes a = atom_types(c);
  // LIGGGHTS: mu' r1 r2/(r1 + r2) F_n; Eq. 8: mu r F_n.
  EXPECT_NEAR(t.rolling(0, 0) * 0.1 / 2, 0.05 * 0.1, 1e-12);
  EXPECT_NEAR(t.rolling(0, 3) * 0.1 * 0.3 / 0.4, 0.05 * 0.1, 1e-12);
  EXPECT_DOUBLE_EQ(t.rolling(0, a.ground() - 1), 0.3);
  EXPECT_DOUBLE_EQ(t.rolling(0, a.dipper() - 1), 0.05);
  EXPECT_DOUBLE_EQ(t.rolling(2, 3), 0);
  EXPECT_DOUBLE_EQ(t.rolling(3, a.ground() - 1), 0);
}

TEST(RockClasses, RefusesAMixOfSpheresAndShapes) {
  cases::Case c = paper_case();
  c.rock.classes[1].shapes = {"sphere", "block"};
  EXPECT_THROW(rock_classes(c), std::invalid_argument);
}

TEST(RockClasses, CoarseGrainingGrowsTheSmallAndSparesTheLarge) {
  cases::RockCase rock;
  rock.coarse_graining = 2;
  EXPECT_DOUBLE_EQ(grained_size_m(rock, 0.85), 1.7);
  rock.coarse_graining_limit_m = 0.6;
  EXPECT_DOUBLE_EQ(grained_size_m(rock, 0.2), 0.4);
  EXPECT_DOUBLE_EQ(grained_size_m(rock, 0.4), 0.6);    // held at the limit
  EXPECT_DOUBLE_EQ(grained_size_m(rock, 0.85), 0.85);  // never made smaller than it is
  rock.coarse_graining = 0.5;
  EXPECT_DOUBLE_EQ(grained_size_m(rock, 0.85), 0.425);  // made finer on purpose
  rock.coarse_graining_limit_m = 0.22;                  // bounds what is made coarser only
  EXPECT_DOUBLE_EQ(grained_size_m(rock, 0.85), 0.425);
}

}  // namespace
}  // namespace dipper::deck
