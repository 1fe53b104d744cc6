// LCM itself, on the private network that a run makes.
#include "coupler/transport/lcm_transport.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>

#include "coupler/launch/network.hpp"

namespace dipper::transport {
namespace {

using namespace std::chrono_literals;

TEST(LcmTransport, CarriesBytesBetweenEndpointsOnThePrivateNetwork) {
  ASSERT_TRUE(launch::enter_private_network());
  const std::string url = "udpm://239.255.76.67:7667?ttl=0";
  LcmTransport a(url, {"TO_A"}), b(url, {"TO_B"});
  const std::string bytes("with\0a zero", 11);
  for (int i = 0; i < 1000; ++i) {
    a.publish("TO_B", bytes);
    const auto at_b = b.receive(1000ms);
    ASSERT_TRUE(at_b) << i;
    EXPECT_EQ(at_b->bytes, bytes);
    EXPECT_EQ(at_b->channel, "TO_B");
    b.publish("TO_A", "pong");
    ASSERT_TRUE(a.receive(1000ms)) << i;
  }
  EXPECT_FALSE(a.receive(10ms));
}

TEST(LcmTransport, WithoutARouteNamesTheCommandThatMakesOne) {
  // A network with nothing in it: its loopback device is down.
  ASSERT_TRUE(unshare(CLONE_NEWNET) == 0 || unshare(CLONE_NEWUSER | CLONE_NEWNET) == 0);
  try {
    LcmTransport t("udpm://239.255.76.67:7667?ttl=0", {"TO_A"});
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("ip route add 239.255.76.0/24 dev lo"));
  }
}

}  // namespace
}  // namespace dipper::transport
