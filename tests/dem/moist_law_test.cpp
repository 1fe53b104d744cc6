#include "dem/moist/moist_law.hpp"

#include <gtest/gtest.h>

namespace dipper::dem::moist {
namespace {

TEST(MoistLaw, PairDiameterOfEqualSpheresIsTheirs) {
  EXPECT_DOUBLE_EQ(pair_diameter(0.1, 0.1), 0.2);
  EXPECT_DOUBLE_EQ(pair_diameter(0.1, 0.3), 0.3);
  EXPECT_NEAR(pair_diameter(0.1, 1e9), 0.4, 1e-9);
}

TEST(MoistLaw, MoistPullIsContinuousAndEnds) {
  EXPECT_EQ(moist_pull(50, -1e-3, 2e-3), 50);
  EXPECT_EQ(moist_pull(50, 0, 2e-3), 50);
  EXPECT_NEAR(moist_pull(50, 1e-12, 2e-3), 50, 1e-6);
  EXPECT_DOUBLE_EQ(moist_pull(50, 1e-3, 2e-3), 25);
  EXPECT_EQ(moist_pull(50, 2e-3, 2e-3), 0);
  EXPECT_EQ(moist_pull(0, 0, 2e-3), 0);
}

TEST(MoistLaw, BondStressesAreThoseOfARoundBar) {
  const Bond b{0.1, 1e7, 3e6};
  const Vector3d n(0, 0, 1);
  const double I = M_PI * std::pow(0.1, 4) / 4;
  Strain s;
  s.gap_m = 1e-4;
  EXPECT_NEAR(bond_stress(b, s, n).tensile_Pa, 1000 / (M_PI * 0.01), 1e-6);
  EXPECT_EQ(bond_stress(b, s, n).shear_Pa, 0);
  s.gap_m = -1e-4;  // the contact carries compression
  EXPECT_EQ(bond_stress(b, s, n).tensile_Pa, 0);
  s = {};
  s.turn_rad = {1e-3, 0, 0};
  const double M = bond_load(b, s, n).moment.norm();
  EXPECT_NEAR(bond_stress(b, s, n).tensile_Pa, M * 0.1 / I, 1e-6);
  s.turn_rad = {0, 0, 1e-3};
  const double T = bond_load(b, s, n).moment.norm();
  EXPECT_NEAR(bond_stress(b, s, n).shear_Pa, T * 0.1 / (2 * I), 1e-6);
  EXPECT_EQ(bond_stress(b, s, n).tensile_Pa, 0);
}

TEST(MoistLaw, BondLoadSignsFollowTheOrderOfTheSpheresToTheBit) {
  const Bond b{0.13, 1.7e7, 4.1e6};
  const Vector3d n = Vector3d(0.3, -0.5, 0.81).normalized();
  const Strain s{3e-5, {1.1e-5, -2.3e-5, 0.7e-5}, {2e-4, -3e-4, 1.7e-4}};
  const Strain swapped{s.gap_m, -s.shear_m, -s.turn_rad};
  const auto one = bond_load(b, s, n), other = bond_load(b, swapped, -n);
  EXPECT_EQ(one.force, -other.force);
  EXPECT_EQ(one.moment, -other.moment);
  EXPECT_EQ(bond_stress(b, s, n).tensile_Pa, bond_stress(b, swapped, -n).tensile_Pa);
  EXPECT_EQ(bond_stress(b, s, n).shear_Pa, bond_stress(b, swapped, -n).shear_Pa);
}

}  // namespace
}  // namespace dipper::dem::moist
