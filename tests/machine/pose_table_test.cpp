#include "machine/pose_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

#include "common/input_error.hpp"
#include "common/temporary_folder.hpp"

namespace dipper::machine {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::string kHeader = "time_s,body,x_m,y_m,z_m,qw,qx,qy,qz\n";

PoseTable table_of(const std::string& rows) {
  const TemporaryFolder folder("poses");
  const auto file = folder.path() / "poses.csv";
  std::ofstream(file) << kHeader << rows;
  return PoseTable::load(file);
}

std::string fault_of(const std::string& rows) {
  try {
    table_of(rows);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

// A quarter turn about z in two rows, and a body that stands.
const std::string kTurn =
    "0,arm,0,0,0,1,0,0,0\n"
    "0,plate,1,2,3,1,0,0,0\n"
    "1,arm,1,0,0,0.923879533,0,0,0.382683432\n"
    "2,arm,2,0,0,0.707106781,0,0,0.707106781\n";

TEST(PoseTable, PassesItsRowsAndStandsBeforeAndAfter) {
  const PoseTable t = table_of(kTurn);
  EXPECT_THAT(t.bodies(), ElementsAre("arm", "plate"));
  EXPECT_EQ(t.end_ns(), 2'000'000'000);
  EXPECT_NEAR(t.at("arm", 1'000'000'000).X_WB.p.x(), 1, 1e-12);
  EXPECT_NEAR(rotation_vector(t.at("arm", 1'000'000'000).X_WB.R).z(), M_PI / 4, 1e-8);
  for (const std::int64_t out : {std::int64_t{-1'000'000'000}, std::int64_t{3'000'000'000}}) {
    EXPECT_EQ(t.at("arm", out).V_WB_W.v.norm(), 0);
    EXPECT_EQ(t.at("arm", out).V_WB_W.w.norm(), 0);
  }
  EXPECT_NEAR(t.at("arm", 3'000'000'000).X_WB.p.x(), 2, 1e-12);
  EXPECT_EQ(t.at("plate", 1'500'000'000).X_WB.p, Vector3d(1, 2, 3));
}

TEST(PoseTable, VelocityIsTheDerivativeAndHasNoJump) {
  const PoseTable t = table_of(
      "0,arm,0,0,0,1,0,0,0\n"
      "1,arm,1,-1,0,0.923879533,0,0,0.382683432\n"
      "2,arm,3,-2,1,0.653281482,0.270598050,0.270598050,0.653281482\n"
      "4,arm,3,0,2,0.5,0.5,0.5,0.5\n");
  for (std::int64_t ms = 50; ms < 4000; ms += 50) {
    const std::int64_t t_ns = ms * 1'000'000, d = 1000;
    const BodyState now = t.at("arm", t_ns);
    const Twist V = twist_between(t.at("arm", t_ns - d).X_WB, t.at("arm", t_ns + d).X_WB, 2e-9 * d);
    EXPECT_LT((now.V_WB_W.v - V.v).norm(), 1e-5) << ms;
    // At a row the axis may turn, which the cubics of the two sides meet to second order.
    if (ms % 1000 == 0) continue;
    EXPECT_LT((now.V_WB_W.w - V.w).norm(), 1e-5) << ms;
  }
  EXPECT_LT(t.at("arm", 1).V_WB_W.v.norm(), 1e-6);
}

TEST(PoseTable, SaysWhatIsWrongAndWhere) {
  EXPECT_THAT(fault_of(""), HasSubstr("no rows"));
  EXPECT_THAT(fault_of("0,arm,0,0,0,1,1,0,0\n"), HasSubstr(":2:1: qw,qx,qy,qz is not a rotation"));
  EXPECT_THAT(fault_of("1,arm,0,0,0,1,0,0,0\n1,arm,0,0,0,1,0,0,0\n"),
              HasSubstr(":3:1: time_s is 1, not after the previous row of arm"));
  EXPECT_THAT(fault_of("0,arm,x,0,0,1,0,0,0\n"), HasSubstr("x_m is \"x\""));
  EXPECT_THAT(fault_of("0,,0,0,0,1,0,0,0\n"), HasSubstr(":2:1: body is empty"));
  EXPECT_THAT(
      fault_of("0,arm,0,0,0,0,0,35,0\n"),
      HasSubstr("its length is 35; it must be 1 within 0.001: a unit quaternion, no angles"));
  EXPECT_THAT(
      fault_of("0,arm,512345.2,7443210.9,182,1,0,0,0\n"),
      HasSubstr(":2:1: x_m,y_m,z_m is 512345.2,7443210.9,182; each must be within 100000 m, "
                "in W"));
  EXPECT_THAT(fault_of("1710000000.5,arm,0,0,0,1,0,0,0\n"),
              HasSubstr(":2:1: time_s is 1710000000.5; it must be within 10000 s"));
}

TEST(PoseTable, OneCauseIsOneLine) {
  std::string rows;
  for (int k = 40; k > 0; --k) rows += std::to_string(k) + ",arm,0,0,0,1,0,0,0\n";
  const std::string fault = fault_of(rows);
  EXPECT_EQ(std::count(fault.begin(), fault.end(), '\n'), 0) << fault;
  EXPECT_THAT(fault, HasSubstr(":3:1: time_s is 39, not after the previous row of arm (40 s), and "
                               "the same in 38 more lines; the times of each body must rise"));
}

/// As programs leave it: a byte-order mark, carriage returns alone, decimal commas, minus signs of
/// word processors, empty columns, the scalar last under its own name.
TEST(PoseTable, IsReadAsTheOtherTablesOfACase) {
  const TemporaryFolder folder("poses");
  const auto file = folder.path() / "poses.csv";
  std::ofstream(file) << "\xEF\xBB\xBFtime_s;body;x_m;y_m;z_m;qx;qy;qz;qw;;\r"
                         "0;\"arm\";\u22121,5;0;0,25;0;0;0;1;;\r"
                         "0,5;\"arm\";\u22121,25;0;0,25;0;\u22120,6;0;0,8;;\r";
  const PoseTable t = PoseTable::load(file);
  ASSERT_EQ(t.rows("arm").size(), 2U);
  EXPECT_EQ(t.rows("arm")[0].X_WB.p, Vector3d(-1.5, 0, 0.25));
  EXPECT_EQ(t.rows("arm")[1].t_ns, 500'000'000);
  EXPECT_EQ(t.rows("arm")[1].line, 3);
  EXPECT_NEAR(t.rows("arm")[1].X_WB.R.w(), 0.8, 1e-12);
  EXPECT_NEAR(t.rows("arm")[1].X_WB.R.y(), -0.6, 1e-12);
}

}  // namespace
}  // namespace dipper::machine
