// The real machine's data and small motions for the shovel's tests.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "machine/kinematics.hpp"
#include "mbs/shovel.hpp"
#include "tests/places.hpp"

namespace dipper::mbs {

constexpr std::int64_t kMillisecond = 1'000'000;

class ShovelTest : public testing::Test {
 protected:
  static std::filesystem::path source() { return test::source(); }

  machine::MachineData machine = machine::load_machine(source() / "mbs/bucyrus495.yaml");
  double rake = machine.dipper.base_rake;
  std::vector<Wrench> no_rock = std::vector<Wrench>(2);

  static machine::Motion motion(const std::string& rows) {
    return machine::Motion::parse("time_s,hoist_m,crowd_m,swing_deg,door_deg\n" + rows, "m.csv");
  }
  static machine::Motion still() { return motion("0,-4,0.5,0,0\n1,-4,0.5,0,0\n"); }
  static machine::Motion quick() {
    return machine::Motion::load(source() / "tests/coupler/case/narrow/motion.csv");
  }

  /// Channels by name.
  static std::map<std::string, double> named(Shovel& shovel, const core::MachineState& s) {
    const core::ServerInfo info = shovel.info();
    EXPECT_EQ(info.channels.size(), s.channels.size());
    std::map<std::string, double> out;
    for (std::size_t i = 0; i < s.channels.size(); ++i) out[info.channels[i].name] = s.channels[i];
    return out;
  }
};

}  // namespace dipper::mbs
