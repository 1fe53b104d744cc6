#include "coupler/core/message.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace dipper::core {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string complaint(const Message& m) {
  try {
    require_sound(m, "dem", {"dipper", "door"});
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "";
}

TEST(RequireSound, NamesSideStepTimeBodyAndQuantity) {
  RockState w;
  w.bodies.resize(2);
  Message m{{"r", "c", 617, 9, 1'234'000'000}, w};
  EXPECT_EQ(complaint(m), "");
  w.bodies[1].mean.force.x() = std::numeric_limits<double>::quiet_NaN();
  m.body = w;
  EXPECT_THAT(complaint(m),
              AllOf(HasSubstr("dem"), HasSubstr("'door'"), HasSubstr("wrench that is not finite"),
                    HasSubstr("sync step 617"), HasSubstr("1.234")));
}

TEST(RequireSound, RefusesARotationThatIsNone) {
  RockStep t;
  t.X_WB_target.resize(1);
  t.X_WB_target[0].R = Quaterniond(0.5, 0, 0, 0);
  EXPECT_THAT(complaint({{}, t}),
              AllOf(HasSubstr("pose"), HasSubstr("'dipper'"), HasSubstr("not of length 1")));
}

}  // namespace
}  // namespace dipper::core
