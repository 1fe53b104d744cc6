#include "machine/pose_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

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
}

}  // namespace
}  // namespace dipper::machine
