#include "coupler/operate/instruments.hpp"

#include "common/gravity.hpp"
#include "mbs/program_operator.hpp"
#include "tests/mbs/shovel_fixture.hpp"

namespace dipper::operate {
namespace {

class InstrumentsTest : public mbs::ShovelTest {
 protected:
  mbs::Shovel shovel(const machine::Motion& m) const {
    return {machine, std::make_shared<machine::Motion>(m), Pose{}, rake,
            std::make_unique<mbs::ProgramOperator>(m.value(0))};
  }
};

// A weight that hangs in the middle of the dipper's inside, held still, is weighed within 1 %; what
// is known of the machine is its file alone.
TEST_F(InstrumentsTest, WeighsWhatHangsStill) {
  for (const char* at : {"0,-4,0.5,0,0\n1,-4,0.5,0,0\n", "0,-9,1.5,30,0\n1,-9,1.5,30,0\n"}) {
    mbs::Shovel driven = shovel(motion(at));
    for (const double load_kg : {0.0, 80e3}) {
      Instruments instruments(driven.info(), machine, rake);
      core::MachineState s = driven.state(0);
      const std::int64_t from_ns = s.t_ns;
      for (int i = 1; i <= 4000; ++i) {
        const Vector3d lever = s.bodies[0].X_WB.R * Vector3d(machine.dipper.inside.x() / 2, 0, 0);
        const Vector3d weight(0, 0, -kGravity_m_s2 * load_kg);
        s = driven.step(
            {from_ns + 2 * i * mbs::kMillisecond, {Wrench{lever.cross(weight), weight}, Wrench{}}});
        if (i > 3900) instruments.see(s);
      }
      EXPECT_NEAR(instruments.show(s).at("payload_estimate_kg").get<double>(), load_kg, 800) << at;
    }
  }
}

TEST_F(InstrumentsTest, CountsAPassAsTheDoorShutsAndRemembers) {
  mbs::Shovel driven = shovel(still());
  const core::ServerInfo info = driven.info();
  Instruments instruments(info, machine, rake);
  core::MachineState s = driven.state(0);
  double& door = s.channels.at(core::channel_index(info, "door"));
  for (const double angle : {0.0, 1.0, 1.2}) {
    door = angle;
    instruments.see(s);
    EXPECT_EQ(instruments.show(s).at("pass"), 1);
  }
  Instruments other(info, machine, rake);
  other.remember(instruments.memory());
  door = 0;
  for (Instruments* one : {&instruments, &other}) {
    one->see(s);
    EXPECT_EQ(one->show(s).at("pass"), 2);
  }
  EXPECT_EQ(instruments.show(s), other.show(s));
}

TEST_F(InstrumentsTest, ADoorThatIsOpenAtTheStartEndsNoPass) {
  mbs::Shovel driven = shovel(still());
  const core::ServerInfo info = driven.info();
  Instruments instruments(info, machine, rake);
  core::MachineState s = driven.state(0);
  double& door = s.channels.at(core::channel_index(info, "door"));
  for (const auto& [angle, pass] : {std::pair{1.2, 1}, {0.0, 1}, {1.2, 1}, {0.0, 2}}) {
    door = angle;
    instruments.see(s);
    EXPECT_EQ(instruments.show(s).at("pass"), pass);
  }
}

TEST_F(InstrumentsTest, ShowsNothingThatOnlyASimulationKnows) {
  mbs::Shovel driven = shovel(still());
  const auto shown = Instruments(driven.info(), machine, rake).show(driven.state(0));
  for (const char* truth :
       {"rope_tension_left", "saddle_pitch", "interface_power", "kinetic_energy"})
    EXPECT_FALSE(shown.contains(truth)) << truth;
  EXPECT_EQ(shown.at("hoist_m"), -4.0);
  EXPECT_EQ(shown.at("sent_crowd_m"), 0.5);
  EXPECT_EQ(shown.size(), 2 + 4 * 3 + 3 * 3 + 1u);
}

TEST_F(InstrumentsTest, AMachineThatFollowsItsMotionIsNotDriven) {
  const mbs::Shovel follows(machine, still(), Pose{}, rake);
  EXPECT_THROW(Instruments(follows.info(), machine, rake), std::invalid_argument);
}

}  // namespace
}  // namespace dipper::operate
