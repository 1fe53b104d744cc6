#include "coupler/transport/seal.hpp"

#include "common/sha256.hpp"

namespace dipper::transport {
namespace {

// Every message begins with its type's fingerprint, then with header.mac.
constexpr std::size_t kMacAt = 8, kMacSize = 32;

/// The channel and its NUL are included: so a request cannot be sent back as a reply.
std::string mac_of(const std::string& secret, const Packet& packet) {
  return hmac_sha256(secret, packet.channel + '\0' + packet.bytes.substr(0, kMacAt) +
                                 packet.bytes.substr(kMacAt + kMacSize));
}

}  // namespace

void seal(const std::string& secret, Packet& packet) {
  packet.bytes.replace(kMacAt, kMacSize, mac_of(secret, packet));
}

bool unseal(const std::string& secret, Packet& packet) {
  if (packet.bytes.size() < kMacAt + kMacSize) return false;
  const std::string mac = mac_of(secret, packet);
  int off = 0;  // in constant time
  for (std::size_t k = 0; k < kMacSize; ++k) off |= mac[k] ^ packet.bytes[kMacAt + k];
  packet.bytes.replace(kMacAt, kMacSize, kMacSize, '\0');
  return off == 0;
}

}  // namespace dipper::transport
