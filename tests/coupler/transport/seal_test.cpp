#include "coupler/transport/seal.hpp"

#include <gtest/gtest.h>

#include "coupler/transport/codec.hpp"
#include "tests/coupler/transport/memory_transport.hpp"

namespace dipper::transport {
namespace {

using namespace std::chrono_literals;

std::string message() {
  return encode({{"run", "case", 1, 2, 3}, core::Command{core::Action::save, "file"}});
}

class Sealed : public testing::Test {
 protected:
  std::unique_ptr<Transport> with(const std::string& secret) {
    return network.connect({"A"}, secret);
  }
  MemoryNetwork network;
};

TEST_F(Sealed, CarriesAMessageAndLeavesNoSealOnIt) {
  const auto a = with("secret"), b = with("secret");
  a->publish("A", message());
  const auto packet = b->receive(1s);
  ASSERT_TRUE(packet);
  EXPECT_EQ(packet->bytes, message());
  EXPECT_EQ(b->foreign(), 0);
}

TEST_F(Sealed, OneBitChangedAnywhereIsNotHeard) {
  const auto a = with("secret"), b = with("secret");
  const auto tap = network.connect({"A"});
  a->publish("A", message());
  ASSERT_TRUE(b->receive(1s));
  const std::string wire = tap->receive(1s)->bytes;
  long sent = 0;
  for (std::size_t i = 0; i < wire.size(); ++i) {
    for (int bit = 0; bit < 8; ++bit, ++sent) {
      std::string changed = wire;
      changed[i] = static_cast<char>(changed[i] ^ (1 << bit));
      tap->publish("A", changed);
      EXPECT_FALSE(b->receive(0us)) << i;
    }
  }
  EXPECT_EQ(b->foreign(), sent);
}

TEST_F(Sealed, AnotherSecretAnotherChannelAndACutAreNotHeard) {
  const auto a = with("secret");
  const auto other = network.connect({"B"});
  const auto tap = network.connect({"A"});
  with("another")->publish("A", message());
  EXPECT_FALSE(a->receive(0us));
  with("secret")->publish("A", message());
  ASSERT_TRUE(a->receive(0us));
  tap->receive(0us);
  const std::string wire = tap->receive(0us)->bytes;
  const auto b = network.connect({"B"}, "secret");
  other->publish("B", wire);
  EXPECT_FALSE(b->receive(0us));
  for (std::size_t n = 0; n < wire.size(); ++n) {
    tap->publish("A", wire.substr(0, n));
    EXPECT_FALSE(a->receive(0us)) << n;
  }
  EXPECT_EQ(a->foreign(), static_cast<long>(wire.size()) + 1);
}

// RFC 4231 has no vector of our layout; Python's hmac gives this one.
TEST_F(Sealed, TheSealIsHmacSha256OfChannelAndMessageWithoutIt) {
  const auto a = with("key");
  const auto tap = network.connect({"A"});
  std::string bytes(8 + 32 + 5, '\0');
  bytes.replace(0, 8, "12345678");
  bytes.replace(40, 5, "hello");
  a->publish("A", bytes);
  const std::string wire = tap->receive(0us)->bytes;
  std::string hex;
  for (int k = 8; k < 40; ++k) {
    constexpr const char* kDigits = "0123456789abcdef";
    hex += kDigits[static_cast<unsigned char>(wire[k]) >> 4];
    hex += kDigits[wire[k] & 15];
  }
  EXPECT_EQ(hex, "8cb5e14e75c4669d20ffedf7680bd8e347a02f6fe812ae62a5e31009b114a027");
}

}  // namespace
}  // namespace dipper::transport
