#include "coupler/dry/estimated_rock.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/gravity.hpp"
#include "coupler/deck/bench_map.hpp"
#include "tests/coupler/case/checkout.hpp"

namespace dipper::dry {
namespace {

using test::Checkout;

constexpr double kStep_s = 1e-2;

/// A dipper 2 m wide, its teeth 3 m in front of its origin and 1 m below, level, over the flat top
/// of quick's bench.
class EstimatedRockTest : public testing::Test {
 protected:
  EstimatedRockTest() {
    const Checkout checkout;
    std::vector<Finding> findings;
    c = cases::load_case(checkout.folder(), {}, findings);
    test::expect_findings(findings, {});
    c.pile.crest_depth_m = 10;  // room for a cut behind the crest
    top = c.pile.height_m;
    estimate.bulk_density_kg_m3 = 2000;
    estimate.capacity_kg = 5000;
    estimate.specific_resistance_Pa = 1e5;
    estimate.lip_left_B = {3, 1, -1};
    estimate.lip_right_B = {3, -1, -1};
    estimate.load_B = {1, 0, 0};
  }

  EstimatedRock rock() const { return {deck::bench_map(c), estimate, kStep_s}; }

  /// Dipper, with its door shut or open, whose teeth are there.
  std::vector<Pose> at(double x, double z, bool open = false) const {
    Pose X_WB;
    X_WB.p = {x - 3, 0, z + 1};
    Pose X_WD = X_WB;
    if (open) X_WD.R = from_rotation_vector({0, 1, 0});
    return {X_WB, X_WD};
  }

  cases::Case c;
  DiggingEstimate estimate;
  double top = 0;
};

double channel(const EstimatedRock& rock, const core::RockState& s, const char* name) {
  return s.channels.at(core::channel_index(rock.info(), name));
}

TEST_F(EstimatedRockTest, ResistsByTheCutsAreaAgainstTheFloor) {
  EstimatedRock r = rock();
  const double x = c.pile.toe_x_m + 14;  // behind the crest
  r.place(at(x, top - 0.5));
  const core::RockState s = r.step({1, at(x + 0.01, top - 0.5)});
  // 0.5 m deep, 2 m wide.
  EXPECT_NEAR(channel(r, s, "cut_depth"), 0.5, 1e-9);
  EXPECT_NEAR(channel(r, s, "cut_resistance"), 1e5 * 0.5 * 2, 1e-6);
  const Wrench& F = s.bodies[0].mean;
  EXPECT_NEAR(F.force.x(), -1e5, 1e-6);
  const double weight = channel(r, s, "mass_in_dipper") * kGravity_m_s2;
  EXPECT_NEAR(F.force.z(), -weight, 1e-6);
  // About B's origin: the push at the teeth, 1 m below; the weight 1 m in front.
  EXPECT_NEAR(F.torque.y(), 1e5 * 1 + weight * 1, 1e-6);
  EXPECT_EQ(s.bodies[1].mean.force.norm(), 0) << "the door feels nothing";
}

TEST_F(EstimatedRockTest, LetsADipperThroughThatMeetsNoRock) {
  EstimatedRock r = rock();
  const double x = c.pile.toe_x_m + 14;
  r.place(at(x, top - 0.5));
  core::RockState s = r.step({1, at(x + 0.5, top - 0.5), false});
  EXPECT_EQ(s.bodies[0].mean.force.norm(), 0);
  EXPECT_EQ(channel(r, s, "cut_depth"), 0);
  EXPECT_EQ(channel(r, s, "mass_in_dipper"), 0);
  s = r.step({1, at(x + 0.51, top - 0.5)});
  EXPECT_NEAR(channel(r, s, "cut_resistance"), 1e5 * 0.5 * 2, 1e-6);
}

TEST_F(EstimatedRockTest, DoesNotResistADipperThatStandsOrComesBack) {
  EstimatedRock r = rock();
  const double x = c.pile.toe_x_m + 14;
  r.place(at(x, top - 0.5));
  EXPECT_EQ(channel(r, r.step({1, at(x, top - 0.5)}), "cut_resistance"), 0);
  EXPECT_EQ(channel(r, r.step({1, at(x - 0.1, top - 0.5)}), "cut_resistance"), 0);
  EXPECT_GT(channel(r, r.step({1, at(x, top - 0.5)}), "cut_resistance"), 0);
}

TEST_F(EstimatedRockTest, CarriesWhatItCutsUpToItsCapacityAndDropsIt) {
  EstimatedRock r = rock();
  const double x = c.pile.toe_x_m + 14;
  r.place(at(x, top - 0.5));
  core::RockState s;
  for (int k = 1; k <= 200; ++k) s = r.step({1, at(x + 0.01 * k, top - 0.5)});
  // 2 m x 2 m x 0.5 m are 4 t; a cell more or less.
  EXPECT_NEAR(channel(r, s, "mass_in_dipper"), 4000, 500);
  for (int k = 201; k <= 400; ++k) s = r.step({1, at(x + 0.01 * k, top - 0.5)});
  EXPECT_EQ(channel(r, s, "mass_in_dipper"), 5000);
  s = r.step({1, at(x + 4, top + 3, true)});
  EXPECT_EQ(channel(r, s, "mass_in_dipper"), 0);
  EXPECT_EQ(channel(r, s, "mass_in_truck"), 5000);
}

TEST_F(EstimatedRockTest, IsNotThereWhenThereIsNone) {
  estimate.there_is_rock = false;
  EstimatedRock r = rock();
  const double x = c.pile.toe_x_m + 14;
  r.place(at(x, top - 0.5));
  const core::RockState s = r.step({3, at(x + 0.1, top - 0.5)});
  EXPECT_EQ(s.bodies[0].mean.force.norm(), 0);
  EXPECT_EQ(s.step, 3);
  EXPECT_EQ(s.t_ns, 30'000'000);
  EXPECT_NEAR(channel(r, s, "teeth_x"), x + 0.1, 1e-12);
  EXPECT_NEAR(channel(r, s, "teeth_z"), top - 0.5, 1e-12);
}

}  // namespace
}  // namespace dipper::dry
