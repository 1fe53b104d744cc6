#include <gtest/gtest.h>

#include "coupler/setup/info_json.hpp"
#include "coupler/setup/machine_setup.hpp"
#include "coupler/setup/peer_config.hpp"
#include "coupler/setup/rock_setup.hpp"

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

TEST(MachineSetup, RoundTripOfAShovel) {
  ShovelSetup s;
  s.model = "a.yaml";
  s.motion = "b.csv";
  s.drives = machine::DriveMode::limited;
  s.contact_on_return = false;
  s.base_position_m = {1, 2, 3};
  s.rake_angle_deg = 61.8;
  s.condition = {1e3, 0.1, 2, 500, {4, 5, 6}, {7, 8, 9}};
  const auto back = std::get<ShovelSetup>(machine_setup_from(to_json(s)));
  EXPECT_EQ(to_json(back), to_json(s));
  EXPECT_EQ(back.drives, s.drives);
  EXPECT_EQ(back.condition.added_inertia_kg_m2.z(), 9);
}

TEST(MachineSetup, RoundTripOfPoses) {
  const auto back =
      std::get<PosesSetup>(machine_setup_from(to_json(PosesSetup{"p.csv", {"bucket", "plate"}})));
  EXPECT_EQ(back.table, "p.csv");
  EXPECT_EQ(back.bodies, (std::vector<std::string>{"bucket", "plate"}));
}

/// No entry has a default: a setting that is lost would be another run's.
TEST(Setup, AMissingEntryThrows) {
  const nlohmann::json shovel = to_json(ShovelSetup{}), poses = to_json(PosesSetup{}),
                       rock = to_json(RockSetup{});
  const auto without = [](nlohmann::json j, const std::string& key) {
    j.erase(key);
    return j;
  };
  for (const nlohmann::json& machine : {shovel, poses})
    for (const auto& [key, value] : machine.items())
      EXPECT_THROW(machine_setup_from(without(machine, key)), nlohmann::json::exception) << key;
  for (const auto& [key, value] : rock.items())
    EXPECT_THROW(rock_setup_from(without(rock, key)), nlohmann::json::exception) << key;
}

TEST(RockSetup, RoundTrip) {
  RockSetup s;
  s.ranks = 3;
  s.deck = "dig.in";
  s.variables = {{"out", "dumps"}};
  s.bodies = {"dipper"};
  s.hold.emplace().below_m_s = 0.02;
  s.layer = HeldLayer{0.5, 30, 6};
  s.floor = FloorStrip{13, 10, 3};
  s.resumed.emplace(1).at(0).load = {Vector3d(1, 2, 3), Vector3d(4, 5, 6)};
  const RockSetup back = rock_setup_from(to_json(s));
  EXPECT_EQ(to_json(back), to_json(s));
  EXPECT_EQ(back.ranks, 3);
  EXPECT_EQ(back.resumed->at(0).load.force.z(), 6);
}

TEST(RandomSecret, IsNewEachTime) {
  EXPECT_EQ(random_secret().size(), 64u);
  EXPECT_NE(random_secret(), random_secret());
}

}  // namespace
}  // namespace dipper::setup
