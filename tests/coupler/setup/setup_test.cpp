#include <gtest/gtest.h>

#include "coupler/setup/info_json.hpp"
#include "coupler/setup/peer_config.hpp"

namespace dipper::setup {
namespace {

TEST(InfoJson, RoundTrip) {
  core::ServerInfo info;
  info.version = "Simbody 3.7";
  info.bodies = {"dipper", "door"};
  info.channels = {{"crowd_force", "N", "-"}};
  info.timestep_s = 2e-4;
  const core::ServerInfo back = info_from_json(to_json(info));
  EXPECT_EQ(back.bodies, info.bodies);
  EXPECT_EQ(back.channels[0].unit, "N");
  EXPECT_EQ(back.timestep_s, 2e-4);
}

TEST(RandomSecret, IsNewEachTime) {
  EXPECT_EQ(random_secret().size(), 64u);
  EXPECT_NE(random_secret(), random_secret());
}

}  // namespace
}  // namespace dipper::setup
