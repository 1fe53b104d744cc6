#include "coupler/transport/sealed_transport.hpp"

#include <fmt/core.h>
#include <glib.h>
#include <sys/random.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string_view>

#include "coupler/transport/lcm_transport.hpp"

namespace dipper::transport {
namespace {

using Mac = std::array<char, 32>;

// Every message begins with its type's fingerprint, then with header.mac.
constexpr std::size_t kMacAt = 8;
constexpr std::size_t kMacEnd = kMacAt + std::tuple_size_v<Mac>;

const guchar* octets(std::string_view text) { return reinterpret_cast<const guchar*>(text.data()); }

/// Over the channel too, so that a request cannot be turned round and played as a reply.
Mac mac_of(const std::string& secret, const std::string& channel, std::string_view bytes) {
  GHmac* hmac = g_hmac_new(G_CHECKSUM_SHA256, octets(secret), secret.size());
  const std::string_view type = bytes.substr(0, kMacAt), rest = bytes.substr(kMacEnd);
  g_hmac_update(hmac, octets(channel), static_cast<gssize>(channel.size() + 1));  // with its NUL
  g_hmac_update(hmac, octets(type), static_cast<gssize>(type.size()));
  g_hmac_update(hmac, octets(rest), static_cast<gssize>(rest.size()));
  Mac mac;
  gsize size = mac.size();
  g_hmac_get_digest(hmac, reinterpret_cast<guint8*>(mac.data()), &size);
  g_hmac_unref(hmac);
  return mac;
}

/// In a time that does not tell how many bytes are right.
bool equal(const Mac& a, const char* b) {
  int off = 0;
  for (std::size_t k = 0; k < a.size(); ++k) off |= a[k] ^ b[k];
  return off == 0;
}

}  // namespace

void SealedTransport::publish(const std::string& channel, const std::string& bytes) {
  std::string sealed = bytes;
  const Mac mac = mac_of(secret_, channel, bytes);
  std::copy(mac.begin(), mac.end(), sealed.begin() + kMacAt);
  transport_->publish(channel, sealed);
}

std::optional<Packet> SealedTransport::receive(std::chrono::microseconds timeout) {
  using Clock = std::chrono::steady_clock;
  const auto deadline = Clock::now() + timeout;
  for (int dropped = 0; dropped < kDropsPerLook || Clock::now() < deadline; ++dropped) {
    const auto left = std::max(Clock::duration::zero(), deadline - Clock::now());
    auto packet = transport_->receive(std::chrono::duration_cast<std::chrono::microseconds>(left));
    if (!packet) return std::nullopt;
    std::string& bytes = packet->bytes;
    if (bytes.size() >= kMacEnd &&
        equal(mac_of(secret_, packet->channel, bytes), bytes.data() + kMacAt)) {
      std::fill(bytes.begin() + kMacAt, bytes.begin() + kMacEnd, '\0');
      return packet;
    }
    ++foreign_;
  }
  return std::nullopt;
}

std::string random_secret() {
  std::array<unsigned char, 32> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
    throw std::runtime_error("the kernel gives no random bytes for the run's secret");
  }
  std::string hex;
  for (const auto b : bytes) hex += fmt::format("{:02x}", b);
  return hex;
}

std::unique_ptr<Transport> sealed_lcm(const std::string& url, const std::string& secret,
                                      const std::string& channel) {
  return std::make_unique<SealedTransport>(
      std::make_unique<LcmTransport>(url, std::set<std::string>{channel}), secret);
}

}  // namespace dipper::transport
