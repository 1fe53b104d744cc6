#include "coupler/transport/codec.hpp"

#include <gtest/gtest.h>

#include "coupler/transport/info_json.hpp"

namespace dipper::transport {
namespace {

core::Envelope envelope() { return {"run", "hash", 12, 34, 56'000'000'000}; }

TEST(Codec, AWrenchSurvivesToTheLastBit) {
  core::WallWrench w;
  w.dem_step = 123456789012;
  w.commit = true;
  core::BodyLoad load;
  load.mean = {{0.1, -1e300, 3}, {4, 5e-308, 6}};
  load.end = {{7, 8, 9}, {1.0 / 3, 2.0 / 3, 1e-17}};
  load.X_WB = {Quaterniond(0.5, -0.5, 0.5, 0.5), {10, 20, 30}};
  w.bodies = {load, core::BodyLoad{}};
  w.channels = {1.25, -2.5};
  const core::Message m = decode(encode({envelope(), w}));
  EXPECT_EQ(m.envelope.run_id, "run");
  EXPECT_EQ(m.envelope.step_index, 12);
  EXPECT_EQ(m.envelope.sequence, 34);
  EXPECT_EQ(m.envelope.t_ns, 56'000'000'000);
  const auto& r = std::get<core::WallWrench>(m.body);
  EXPECT_EQ(r.dem_step, w.dem_step);
  EXPECT_TRUE(r.commit);
  ASSERT_EQ(r.bodies.size(), 2u);
  EXPECT_EQ(r.bodies[0].mean.torque, load.mean.torque);
  EXPECT_EQ(r.bodies[0].mean.force, load.mean.force);
  EXPECT_EQ(r.bodies[0].end.torque, load.end.torque);
  EXPECT_EQ(r.bodies[0].end.force, load.end.force);
  EXPECT_EQ(r.bodies[0].X_WB.R.coeffs(), load.X_WB.R.coeffs());
  EXPECT_EQ(r.bodies[0].X_WB.p, load.X_WB.p);
  EXPECT_EQ(r.channels, w.channels);
}

TEST(Codec, MotionCommandAndStatusSurvive) {
  core::TargetMotion t;
  t.n_steps = 20;
  t.contact = false;
  t.bodies = {{{Quaterniond(0, 1, 0, 0), {1, 2, 3}}, {{4, 5, 6}, {7, 8, 9}}}};
  const auto motion = std::get<core::TargetMotion>(decode(encode({envelope(), t})).body);
  EXPECT_EQ(motion.n_steps, 20);
  EXPECT_FALSE(motion.contact);
  EXPECT_EQ(motion.bodies[0].V_WB_W.w, Vector3d(4, 5, 6));
  EXPECT_EQ(motion.bodies[0].V_WB_W.v, Vector3d(7, 8, 9));
  EXPECT_EQ(motion.bodies[0].X_WB.R.x(), 1.0);

  const auto command = std::get<core::Command>(
      decode(encode({envelope(), core::Command{core::Action::save, "f"}})).body);
  EXPECT_EQ(command.action, core::Action::save);
  EXPECT_EQ(command.file, "f");
  const auto status =
      std::get<core::Status>(decode(encode({envelope(), core::Status{false, "why"}})).body);
  EXPECT_FALSE(status.ok);
  EXPECT_EQ(status.text, "why");
}

TEST(Codec, RefusesEveryCutAndEveryExtension) {
  core::WallWrench w;
  w.bodies.resize(2);
  w.channels = {1, 2, 3};
  const std::string bytes = encode({envelope(), w});
  for (std::size_t n = 0; n < bytes.size(); ++n) {
    EXPECT_THROW(decode(bytes.substr(0, n)), DecodeError) << n;
  }
  EXPECT_THROW(decode(bytes + "x"), DecodeError);
}

// LCM's own decoder reads out of place for the first and asks for gigabytes for the second.
TEST(Codec, LengthsThatCannotBeAreRefusedBeforeAnythingIsMadeOfThem) {
  const std::string command = encode({envelope(), core::Command{core::Action::save, "file"}});
  const std::size_t run_id = 8 + 32;
  for (const char* length : {"\x80\0\0\0", "\xff\xff\xff\xff", "\0\0\0\0", "\x7f\xff\xff\xff"}) {
    std::string wild = command;
    wild.replace(run_id, 4, std::string(length, 4));
    EXPECT_THROW(decode(wild), DecodeError);
    wild = command;
    wild.replace(wild.size() - 9, 4, std::string(length, 4));  // of "file"
    EXPECT_THROW(decode(wild), DecodeError);
  }
  std::string wrench = encode({envelope(), core::WallWrench{}});
  wrench.replace(wrench.size() - 8, 4, std::string("\x7f\xff\xff\xff", 4));  // bodies
  EXPECT_THROW(decode(wrench), DecodeError);
}

TEST(Codec, GarbageIsAnErrorNotACrash) {
  core::WallWrench w;
  w.bodies.resize(1);
  const std::string bytes = encode({envelope(), w});
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    for (const int flip : {0x01, 0x80, 0xff}) {
      std::string broken = bytes;
      broken[i] = static_cast<char>(broken[i] ^ flip);
      try {
        decode(broken);  // a flipped number is still a message
      } catch (const DecodeError&) {
      }
    }
  }
}

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

}  // namespace
}  // namespace dipper::transport
