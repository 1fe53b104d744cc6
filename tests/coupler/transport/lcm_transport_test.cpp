// LCM itself, on the private network that a run makes.
#include "coupler/transport/lcm_transport.hpp"

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <random>
#include <thread>

#include "coupler/launch/network.hpp"
#include "coupler/transport/codec.hpp"

namespace dipper::transport {
namespace {

using namespace std::chrono_literals;

std::string message(const std::string& text) {
  core::Message m;
  m.envelope.run_id = "run";
  m.body = core::Status{true, text};
  return encode(m);
}

TEST(LcmTransport, CarriesBytesBetweenEndpointsOnThePrivateNetwork) {
  ASSERT_TRUE(launch::enter_private_network());
  LcmTransport a(kLcmUrl, "TO_A", "secret"), b(kLcmUrl, "TO_B", "secret");
  const std::string bytes = message("with a text");
  for (int i = 0; i < 1000; ++i) {
    a.publish("TO_B", bytes);
    const auto at_b = b.receive(1000ms);
    ASSERT_TRUE(at_b) << i;
    EXPECT_EQ(at_b->bytes, bytes);
    EXPECT_EQ(at_b->channel, "TO_B");
    b.publish("TO_A", message("pong"));
    ASSERT_TRUE(a.receive(1000ms)) << i;
  }
  EXPECT_FALSE(a.receive(10ms));
}

/// Sends bytes as they are to the group.
class Stranger {
 public:
  Stranger() : socket_(socket(AF_INET, SOCK_DGRAM, 0)) {
    group_.sin_family = AF_INET;
    group_.sin_port = htons(7667);
    inet_pton(AF_INET, "239.255.76.67", &group_.sin_addr);
  }
  ~Stranger() { close(socket_); }
  void send(const std::string& bytes) const {
    sendto(socket_, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&group_),
           sizeof group_);
  }

 private:
  int socket_;
  sockaddr_in group_{};
};

std::string big_endian(std::uint32_t n) {
  const std::uint32_t net = htonl(n);
  return {reinterpret_cast<const char*>(&net), 4};
}

// Each of these ends a process whose receiver is liblcm's.
TEST(LcmTransport, PacketsThatAreNoneAreDropped) {
  ASSERT_TRUE(launch::enter_private_network());
  LcmTransport a(kLcmUrl, "TO_A", "secret"), b(kLcmUrl, "TO_B", "secret");
  const Stranger stranger;
  const std::string no_nul = "LC02" + big_endian(1) + std::string(200, 'x');
  const std::string no_end = "LC02" + big_endian(1) + "TO_A";
  const std::string empty, magic = "LC02";
  // Of a message of 100 bytes, the piece at 4 GB.
  const std::string wild = "LC03" + big_endian(7) + big_endian(100) + big_endian(0xfffffff0u) +
                           std::string("\0\0\0\2", 4) + std::string("TO_A\0 wild", 10);
  const std::string no_seal = "LC02" + big_endian(1) + std::string("TO_A\0", 5);
  for (int k = 0; k < 20; ++k) {
    for (const auto& bytes : {no_nul, no_end, empty, magic, wild, no_seal}) stranger.send(bytes);
  }
  b.publish("TO_A", message("still there"));
  const auto packet = a.receive(1000ms);
  ASSERT_TRUE(packet);
  EXPECT_EQ(packet->bytes, message("still there"));
  EXPECT_EQ(a.foreign(), 20);  // those that name its channel
}

// A process that reads nothing would otherwise have them all in its queue.
TEST(LcmTransport, OtherChannelsDoNotFillItsQueue) {
  ASSERT_TRUE(launch::enter_private_network());
  LcmTransport a(kLcmUrl, "TO_A", "secret"), b(kLcmUrl, "TO_B", "secret");
  b.publish("TO_A", message("first"));
  for (int k = 0; k < 1000; ++k) {
    for (const auto* other : {"TO_B", "TO_", "TO_AB"}) a.publish(other, message("else"));
  }
  b.publish("TO_A", message("last"));
  for (const auto* text : {"first", "last"}) {
    const auto packet = a.receive(1000ms);
    ASSERT_TRUE(packet) << text;
    EXPECT_EQ(packet->bytes, message(text));
  }
  EXPECT_FALSE(a.receive(0us));
}

TEST(LcmTransport, WhatDoesNotFitOnePacketIsNotSent) {
  ASSERT_TRUE(launch::enter_private_network());
  LcmTransport a(kLcmUrl, "TO_A", "secret");
  const std::string most(65499 - 5, '\0');  // with "TO_A" and its NUL
  a.publish("TO_A", most);
  const auto packet = a.receive(1000ms);
  ASSERT_TRUE(packet);
  EXPECT_EQ(packet->bytes, most);
  EXPECT_THROW(a.publish("TO_A", most + "x"), std::runtime_error);
}

TEST(LcmTransport, AnswersComeThroughAFlood) {
  ASSERT_TRUE(launch::enter_private_network());
  LcmTransport a(kLcmUrl, "TO_A", "secret"), b(kLcmUrl, "TO_B", "secret");
  std::atomic<bool> over{false};
  std::atomic<long> sent{0};
  std::thread flood([&] {  // 40,000 a second, on the channel itself
    const Stranger stranger;
    std::mt19937 random(1);
    const auto began = std::chrono::steady_clock::now();
    while (!over) {
      const auto due = 40 * ((std::chrono::steady_clock::now() - began) / 1ms);
      for (; sent < due; ++sent) {
        std::string bytes = "LC02" + big_endian(1) + std::string("TO_A\0", 5);
        bytes.resize(bytes.size() + random() % 400, static_cast<char>(random()));
        stranger.send(bytes);
      }
      std::this_thread::sleep_for(1ms);
    }
  });
  int heard = 0;
  const auto began = std::chrono::steady_clock::now();
  int asked = 0;
  for (; asked < 500 || a.foreign() < 5000; ++asked) {
    while (a.receive(0us)) ++heard;  // empties the queue, as Link does
    b.publish("TO_A", message("text"));
    if (a.receive(200ms)) ++heard;
  }
  const auto took = std::chrono::steady_clock::now() - began;
  over = true;
  flood.join();
  EXPECT_GT(heard, asked * 8 / 10);
  EXPECT_LT(took, 30s);
  // And silence ends when it should.
  const auto waited = std::chrono::steady_clock::now();
  EXPECT_FALSE(b.receive(300ms));
  EXPECT_LT(std::chrono::steady_clock::now() - waited, 600ms);
}

TEST(LcmPacket, ReadsWhatLcmSends) {
  const auto packet = read_lcm_packet({"LC02\0\0\0\1CHANNEL\0bytes", 21});
  ASSERT_TRUE(packet);
  EXPECT_EQ(packet->channel, "CHANNEL");
  EXPECT_EQ(packet->bytes, "bytes");
}

TEST(LcmPacket, RefusesEverythingElse) {
  const std::string whole("LC02\0\0\0\1CHANNEL\0bytes", 21);
  for (std::size_t n = 0; n < 16; ++n) EXPECT_FALSE(read_lcm_packet(whole.substr(0, n))) << n;
  EXPECT_FALSE(read_lcm_packet("LC03" + whole.substr(4)));  // a fragment
  EXPECT_FALSE(read_lcm_packet(whole.substr(0, 8) + std::string(64, 'x') + std::string(1, '\0')));
  EXPECT_TRUE(read_lcm_packet(whole.substr(0, 8) + std::string(63, 'x') + std::string(1, '\0')));
}

TEST(LcmTransport, WithoutARouteNamesTheCommandThatMakesOne) {
  // A network with nothing in it: its loopback device is down.
  ASSERT_TRUE(unshare(CLONE_NEWNET) == 0 || unshare(CLONE_NEWUSER | CLONE_NEWNET) == 0);
  try {
    LcmTransport t(kLcmUrl, "TO_A", "secret");
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("ip route add 239.255.76.0/24 dev lo"));
  }
}

}  // namespace
}  // namespace dipper::transport
