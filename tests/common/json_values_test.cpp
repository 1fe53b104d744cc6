#include "common/json_values.hpp"

#include <gtest/gtest.h>

namespace dipper {
namespace {

using nlohmann::json;

TEST(JsonValues, ComeBackBitForBit) {
  const Pose X{Quaterniond(0.1, 1.0 / 3, -0.7, 0.6), Vector3d(1.0 / 7, -2e-300, 3e300)};
  const Pose back = pose_from(json::parse(json_of(X).dump()));
  EXPECT_EQ(back.p, X.p);
  EXPECT_EQ(back.R.coeffs(), X.R.coeffs());
  EXPECT_EQ(quaternion_from(json_of(X.R)).coeffs(), X.R.coeffs());
  EXPECT_EQ(vector_from(json_of(X.p)), X.p);

  const Wrench F{{1, 2, 3}, {4, 5, 6}};
  EXPECT_EQ(json_of(F).dump(), "[1.0,2.0,3.0,4.0,5.0,6.0]");
  EXPECT_EQ(wrench_from(json_of(F)).force, F.force);
  EXPECT_EQ(wrench_from(json_of(F)).torque, F.torque);
  const Twist V{{1, 2, 3}, {4, 5, 6}};
  EXPECT_EQ(twist_from(json_of(V)).w, V.w);
  EXPECT_EQ(twist_from(json_of(V)).v, V.v);
}

TEST(JsonValues, OtherListsAreRefused) {
  for (const char* text : {"[1,2]", "[1,2,3,4]", "[1,2,\"3\"]", "{\"x\":1}", "null", "[1,2,null]"})
    EXPECT_THROW(vector_from(json::parse(text)), json::exception) << text;
}

}  // namespace
}  // namespace dipper
