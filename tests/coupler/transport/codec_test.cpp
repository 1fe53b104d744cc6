#include "coupler/transport/codec.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dipper_msg/command_t.hpp"
#include "dipper_msg/status_t.hpp"
#include "dipper_msg/target_motion_t.hpp"
#include "dipper_msg/wall_wrench_t.hpp"

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

/// What lcm-gen's decoder makes of our bytes, and its encoder of that.
template <class Type>
Type through_lcm(const core::Message& m) {
  const std::string bytes = encode(m);
  const int size = static_cast<int>(bytes.size());
  Type t;
  EXPECT_EQ(t.decode(bytes.data(), 0, size), size);
  std::string again(bytes.size(), '\0');
  EXPECT_EQ(t.encode(again.data(), 0, size), size);
  EXPECT_EQ(again, bytes);
  EXPECT_EQ(t.header.run_id, "run");
  EXPECT_EQ(t.header.case_hash, "hash");
  EXPECT_EQ(t.header.step_index, 12);
  EXPECT_EQ(t.header.sequence, 34);
  EXPECT_EQ(t.header.t_ns, 56'000'000'000);
  return t;
}

TEST(Codec, LcmReadsWhatWeWrite) {
  core::TargetMotion motion;
  motion.n_steps = 20;
  motion.bodies = {{{Quaterniond(0.5, -0.5, 0.5, 0.25), {1, 2, 3}}, {{4, 5, 6}, {7, 8, 9}}}};
  motion.channels = {-1.5};
  const auto m = through_lcm<dipper_msg::target_motion_t>({envelope(), motion});
  EXPECT_EQ(m.n_steps, 20);
  EXPECT_EQ(m.contact, 1);
  ASSERT_EQ(m.n_bodies, 1);
  EXPECT_THAT(m.bodies[0].p_WBo_W, testing::ElementsAre(1, 2, 3));
  EXPECT_THAT(m.bodies[0].R_WB, testing::ElementsAre(0.5, -0.5, 0.5, 0.25));
  EXPECT_THAT(m.bodies[0].w_WB_W, testing::ElementsAre(4, 5, 6));
  EXPECT_THAT(m.bodies[0].v_WBo_W, testing::ElementsAre(7, 8, 9));
  EXPECT_EQ(m.channels, motion.channels);

  core::WallWrench wrench;
  wrench.dem_step = -1;
  wrench.commit = true;
  wrench.bodies = {
      {{{1, 2, 3}, {4, 5, 6}}, {{7, 8, 9}, {10, 11, 12}}, {Quaterniond(0, 1, 0, 0), {13, 14, 15}}}};
  const auto w = through_lcm<dipper_msg::wall_wrench_t>({envelope(), wrench});
  EXPECT_EQ(w.dem_step, -1);
  EXPECT_EQ(w.commit, 1);
  ASSERT_EQ(w.n_bodies, 1);
  EXPECT_THAT(w.bodies[0].mean_torque_Bo_W, testing::ElementsAre(1, 2, 3));
  EXPECT_THAT(w.bodies[0].mean_force_Bo_W, testing::ElementsAre(4, 5, 6));
  EXPECT_THAT(w.bodies[0].end_torque_Bo_W, testing::ElementsAre(7, 8, 9));
  EXPECT_THAT(w.bodies[0].end_force_Bo_W, testing::ElementsAre(10, 11, 12));
  EXPECT_THAT(w.bodies[0].p_WBo_W, testing::ElementsAre(13, 14, 15));
  EXPECT_THAT(w.bodies[0].R_WB, testing::ElementsAre(0, 1, 0, 0));
  EXPECT_EQ(w.n_channels, 0);

  const auto c =
      through_lcm<dipper_msg::command_t>({envelope(), core::Command{core::Action::save, "f"}});
  EXPECT_EQ(c.action, 3);
  EXPECT_EQ(c.file, "f");
  const auto s = through_lcm<dipper_msg::status_t>({envelope(), core::Status{false, "why"}});
  EXPECT_EQ(s.ok, 0);
  EXPECT_EQ(s.text, "why");
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
