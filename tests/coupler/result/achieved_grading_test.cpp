#include "coupler/result/achieved_grading.hpp"

#include <gtest/gtest.h>

#include "tests/coupler/deck/liggghts_run.hpp"
#include "tests/coupler/deck/quick_case.hpp"

namespace dipper::result {
namespace {

TEST(AchievedGrading, CountsRocksNotTheirSpheres) {
  const auto folder = deck::fresh_folder("achieved");
  cases::Case c = deck::quick_case();
  c.rock.coarse_graining = 1;
  c.rock.classes = {{"small", 0.2, 60, {"sphere"}}, {"large", 0.4, 40, {"block"}}};
  // 8 small spheres and a large rock of three spheres: equal masses. A later frame does not count.
  std::string text = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n11\nITEM: BOX BOUNDS ff ff ff\n";
  text += "-1 1\n-1 1\n-1 1\nITEM: ATOMS id type id_multisphere x y z radius\n";
  for (int i = 1; i <= 8; ++i) text += std::to_string(i) + " 1 -1 0 0 0 0.1\n";
  for (int i = 9; i <= 11; ++i) text += std::to_string(i) + " 2 7 0 0 0 0.1\n";
  std::ofstream(folder / "rocks_0.dump") << text;
  std::ofstream(folder / "rocks_100.dump") << "not read\n";
  const auto classes = achieved_grading(c, folder);
  ASSERT_EQ(classes.size(), 2U);
  EXPECT_EQ(classes[0].rocks, 8U);
  EXPECT_EQ(classes[1].rocks, 1U);
  EXPECT_NEAR(classes[0].mass_percent, 50, 1e-9);
  EXPECT_NEAR(classes[1].mass_percent, 50, 1e-9);
  EXPECT_EQ(to_csv(classes),
            "class,size_m,rocks,mass_percent,wanted_percent\n"
            "small,0.2,8,50.00,60.00\nlarge,0.4,1,50.00,40.00\n");
}

}  // namespace
}  // namespace dipper::result
