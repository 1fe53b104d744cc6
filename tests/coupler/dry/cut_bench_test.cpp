#include "coupler/dry/cut_bench.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/coupler/case/checkout.hpp"

namespace dipper::dry {
namespace {

using test::Checkout;

cases::Case quick() {
  const Checkout checkout;
  std::vector<Finding> findings;
  cases::Case c = cases::load_case(checkout.folder(), {}, findings);
  test::expect_findings(findings, {});
  c.pile.crest_depth_m = 10;  // room for a cut behind the crest
  return c;
}

TEST(CutBench, StandsAsTheCaseHasIt) {
  const cases::Case c = quick();
  const CutBench bench(c);
  const double crest_x =
      c.pile.toe_x_m + c.pile.height_m / std::tan(c.pile.face_angle_deg * M_PI / 180);
  EXPECT_NEAR(bench.height(crest_x + 1, 0), c.pile.height_m, 1e-9);
  EXPECT_NEAR(bench.height(0.5 * (c.pile.toe_x_m + crest_x), 0), c.pile.height_m / 2,
              CutBench::kCell_m);
  EXPECT_EQ(bench.height(c.pile.toe_x_m - 1, 0), 0) << "in front of the toe";
  EXPECT_EQ(bench.height(crest_x + 1, c.pile.width_m), 0) << "beside the bench";
}

TEST(CutBench, AnEdgeTakesWhatLiesAboveItsWay) {
  const cases::Case c = quick();
  CutBench bench(c);
  // A level cut 2 m under the flat top, 1 m wide: 2 m x 2 m x 1 m of rock, to a cell's breadth.
  const double x0 = c.pile.toe_x_m + c.pile.height_m / std::tan(0.58) + 1, z = c.pile.height_m - 2;
  const double volume_m3 =
      bench.cut({x0, 0.5, z}, {x0, -0.5, z}, {x0 + 2, 0.5, z}, {x0 + 2, -0.5, z});
  EXPECT_NEAR(volume_m3, 4, 4 * 0.25);
  EXPECT_NEAR(bench.height(x0 + 1, 0), z, 1e-12);
  EXPECT_NEAR(bench.height(x0 + 1, 1), c.pile.height_m, 1e-9) << "beside the edge nothing is cut";
  EXPECT_EQ(bench.cut({x0, 0.5, z}, {x0, -0.5, z}, {x0 + 2, 0.5, z}, {x0 + 2, -0.5, z}), 0)
      << "what is gone is gone";
  EXPECT_GT(bench.cut({x0, 0.5, -1}, {x0, -0.5, -1}, {x0 + 2, 0.5, -1}, {x0 + 2, -0.5, -1}), 0);
  EXPECT_EQ(bench.height(x0 + 1, 0), 0) << "the ground stays";
}

}  // namespace
}  // namespace dipper::dry
