#include "coupler/transport/codec.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dipper_msg/command_t.hpp"
#include "dipper_msg/machine_state_t.hpp"
#include "dipper_msg/machine_step_t.hpp"
#include "dipper_msg/rock_place_t.hpp"
#include "dipper_msg/rock_state_t.hpp"
#include "dipper_msg/rock_step_t.hpp"
#include "dipper_msg/status_t.hpp"

namespace dipper::transport {
namespace {

core::Envelope envelope() { return {"run", "hash", 12, 34, 56'000'000'000}; }

bool same(const Pose& a, const Pose& b) { return a.R.coeffs() == b.R.coeffs() && a.p == b.p; }
bool same(const Wrench& a, const Wrench& b) { return a.torque == b.torque && a.force == b.force; }

const Pose kPose{Quaterniond(0.5, -0.5, 0.5, 0.5), {10, 20, 1.0 / 3}};
const core::Order kOrder{58'000'000'000, {1.0 / 3, -5e-308}};
const Wrench kWrench{{0.1, -1e300, 3}, {4, 5e-308, 6}};

TEST(Codec, TheRocksMessagesSurviveToTheLastBit) {
  core::RockState w;
  w.step = 123456789012;
  w.bodies = {{kWrench, {{7, 8, 9}, {1.0 / 3, 2.0 / 3, 1e-17}}, kPose}, core::BodyLoad{}};
  w.channels = {1.25, -2.5};
  const core::Message m = decode(encode({envelope(), w}));
  EXPECT_EQ(m.envelope.run_id, "run");
  EXPECT_EQ(m.envelope.step_index, 12);
  EXPECT_EQ(m.envelope.sequence, 34);
  EXPECT_EQ(m.envelope.t_ns, 56'000'000'000);
  const auto& r = std::get<core::RockState>(m.body);
  EXPECT_EQ(r.step, w.step);
  EXPECT_EQ(r.t_ns, 56'000'000'000);
  ASSERT_EQ(r.bodies.size(), 2u);
  EXPECT_TRUE(same(r.bodies[0].mean, w.bodies[0].mean));
  EXPECT_TRUE(same(r.bodies[0].end, w.bodies[0].end));
  EXPECT_TRUE(same(r.bodies[0].X_WB, kPose));
  EXPECT_EQ(r.channels, w.channels);

  const auto step = std::get<core::RockStep>(
      decode(encode({envelope(), core::RockStep{20, {kPose}, false}})).body);
  EXPECT_EQ(step.n_steps, 20);
  EXPECT_FALSE(step.contact);
  EXPECT_TRUE(same(step.X_WB_target.at(0), kPose));
  EXPECT_EQ(step.t_end_ns, 56'000'000'000) << "the header's";
  EXPECT_EQ(step.step_index, 12);
  const auto place =
      std::get<core::RockPlace>(decode(encode({envelope(), core::RockPlace{{kPose, {}}}})).body);
  EXPECT_EQ(place.X_WB.size(), 2u);
  EXPECT_TRUE(same(place.X_WB[0], kPose));
}

TEST(Codec, TheMachinesMessagesSurvive) {
  const auto step = std::get<core::MachineStep>(
      decode(encode({envelope(), core::MachineStep{1, {kWrench, {}}, 57'000'000'000, 0, kOrder}}))
          .body);
  EXPECT_EQ(step.t_end_ns, 56'000'000'000) << "the header's";
  EXPECT_EQ(step.t_next_ns, 57'000'000'000);
  EXPECT_EQ(step.step_index, 12);
  ASSERT_EQ(step.F_Bo_W.size(), 2u);
  EXPECT_TRUE(same(step.F_Bo_W[0], kWrench));
  EXPECT_EQ(step.order.by_ns, kOrder.by_ns);
  EXPECT_EQ(step.order.to, kOrder.to);

  core::MachineState s;
  s.t_ns = 55;
  s.contact = false;
  s.bodies = {{kPose, {{4, 5, 6}, {7, 8, 9}}}};
  s.X_WB_next = {Pose{}, kPose};
  s.channels = {0.5};
  const auto state = std::get<core::MachineState>(decode(encode({envelope(), s})).body);
  EXPECT_EQ(state.t_ns, 55);
  EXPECT_FALSE(state.contact);
  EXPECT_TRUE(same(state.bodies.at(0).X_WB, kPose));
  EXPECT_EQ(state.bodies[0].V_WB_W.w, Vector3d(4, 5, 6));
  EXPECT_EQ(state.bodies[0].V_WB_W.v, Vector3d(7, 8, 9));
  EXPECT_TRUE(same(state.X_WB_next.at(1), kPose));
  EXPECT_EQ(state.channels, s.channels);
}

TEST(Codec, CommandAndStatusSurvive) {
  const auto command = std::get<core::Command>(
      decode(encode({envelope(), core::Command{core::Action::save, "f"}})).body);
  EXPECT_EQ(command.action, core::Action::save);
  EXPECT_EQ(command.text, "f");
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

void expect_equal(const dipper_msg::pose_t& t, const Pose& X) {
  EXPECT_THAT(t.p_WBo_W, testing::ElementsAre(X.p.x(), X.p.y(), X.p.z()));
  EXPECT_THAT(t.R_WB, testing::ElementsAre(X.R.w(), X.R.x(), X.R.y(), X.R.z()));
}
void expect_equal(const dipper_msg::wrench_t& t, const Wrench& F) {
  EXPECT_EQ(Vector3d(t.torque_Bo_W), F.torque);
  EXPECT_EQ(Vector3d(t.force_Bo_W), F.force);
}

TEST(Codec, LcmReadsTheMachinesMessages) {
  const auto step = through_lcm<dipper_msg::machine_step_t>(
      {envelope(), core::MachineStep{1, {kWrench}, -57'000'000'000, 0, kOrder}});
  EXPECT_EQ(step.t_next_ns, -57'000'000'000);
  EXPECT_EQ(step.order_by_ns, kOrder.by_ns);
  EXPECT_EQ(step.order, kOrder.to);
  ASSERT_EQ(step.n_bodies, 1);
  expect_equal(step.wrenches[0], kWrench);

  core::MachineState s;
  s.t_ns = 55;
  s.bodies = {{kPose, {{4, 5, 6}, {7, 8, 9}}}};
  s.X_WB_next = {Pose{}, kPose};
  s.channels = {0.5};
  const auto state = through_lcm<dipper_msg::machine_state_t>({envelope(), s});
  EXPECT_EQ(state.t_ns, 55);
  EXPECT_EQ(state.contact, 1);
  ASSERT_EQ(state.n_bodies, 1);
  expect_equal(state.bodies[0].X_WB, kPose);
  EXPECT_THAT(state.bodies[0].V_WB_W.w_WB_W, testing::ElementsAre(4, 5, 6));
  EXPECT_THAT(state.bodies[0].V_WB_W.v_WBo_W, testing::ElementsAre(7, 8, 9));
  ASSERT_EQ(state.n_next, 2);
  expect_equal(state.next[1], kPose);
  EXPECT_EQ(state.channels, s.channels);
}

TEST(Codec, LcmReadsTheRocksMessages) {
  const auto place =
      through_lcm<dipper_msg::rock_place_t>({envelope(), core::RockPlace{{Pose{}, kPose}}});
  ASSERT_EQ(place.n_bodies, 2);
  expect_equal(place.bodies[1], kPose);
  const auto step =
      through_lcm<dipper_msg::rock_step_t>({envelope(), core::RockStep{20, {kPose}, true}});
  EXPECT_EQ(step.n_steps, 20);
  EXPECT_EQ(step.contact, 1);
  expect_equal(step.targets.at(0), kPose);

  core::RockState r;
  r.step = -1;
  r.bodies = {{kWrench, {{7, 8, 9}, {10, 11, 12}}, kPose}};
  const auto state = through_lcm<dipper_msg::rock_state_t>({envelope(), r});
  EXPECT_EQ(state.dem_step, -1);
  ASSERT_EQ(state.n_bodies, 1);
  expect_equal(state.bodies[0].mean, r.bodies[0].mean);
  expect_equal(state.bodies[0].end, r.bodies[0].end);
  expect_equal(state.bodies[0].X_WB, kPose);
  EXPECT_EQ(state.n_channels, 0);
}

TEST(Codec, LcmReadsCommandAndStatus) {
  const auto c =
      through_lcm<dipper_msg::command_t>({envelope(), core::Command{core::Action::save, "f"}});
  EXPECT_EQ(c.action, 3);
  EXPECT_EQ(c.text, "f");
  const auto s = through_lcm<dipper_msg::status_t>({envelope(), core::Status{false, "why"}});
  EXPECT_EQ(s.ok, 0);
  EXPECT_EQ(s.text, "why");
}

TEST(Codec, RefusesEveryCutAndEveryExtension) {
  const std::vector<core::Body> bodies = {
      core::MachineStep{0, {kWrench, kWrench}, 0, 0, kOrder},
      core::MachineState{0, {{kPose, {}}, {kPose, {}}}, {1, 2}, true, {kPose, kPose}},
      core::RockPlace{{kPose, kPose}},
      core::RockStep{5, {kPose, kPose}},
      core::RockState{7, 0, {{}, {}}, {1, 2, 3}},
      core::Command{core::Action::save, "file"},
      core::Status{true, "text"}};
  for (const core::Body& body : bodies) {
    const std::string bytes = encode({envelope(), body});
    EXPECT_EQ(decode(bytes).body.index(), body.index());
    for (std::size_t n = 0; n < bytes.size(); ++n) {
      EXPECT_THROW(decode(bytes.substr(0, n)), DecodeError) << n;
    }
    EXPECT_THROW(decode(bytes + "x"), DecodeError);
  }
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
  std::string wrench = encode({envelope(), core::RockState{}});
  wrench.replace(wrench.size() - 8, 4, std::string("\x7f\xff\xff\xff", 4));  // bodies
  EXPECT_THROW(decode(wrench), DecodeError);
}

TEST(Codec, GarbageIsAnErrorNotACrash) {
  core::RockState w;
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

}  // namespace
}  // namespace dipper::transport
