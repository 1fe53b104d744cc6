#pragma once

#include <lcm/lcm-cpp.hpp>
#include <string_view>
#include <vector>

#include "coupler/transport/transport.hpp"

namespace dipper::transport {

/// Where the processes of a run meet: on this machine, in a network of the run's own.
inline constexpr const char* kLcmUrl = "udpm://239.255.76.67:7667?ttl=0";

/// What a datagram of LCM carries ("LC02", a number, the channel with its NUL, the message).
/// Nothing of a fragment: our messages fit one packet, and putting strangers' pieces together is
/// how a receiver is led to write where it must not.
std::optional<Packet> read_lcm_packet(std::string_view datagram);

/// LCM over UDP multicast, every message sealed. ttl=0 in the URL keeps packets on this host.
/// liblcm sends; we receive on a socket of our own, since liblcm's receiver trusts what comes in: a
/// channel without its NUL or a fragment with a wild offset is the end of its process.
class LcmTransport final : public Transport {
 public:
  /// Hears `channel`. Throws std::runtime_error, with the cure when there is no multicast route.
  LcmTransport(const std::string& url, std::string channel, std::string secret);
  ~LcmTransport() override;
  LcmTransport(const LcmTransport&) = delete;
  LcmTransport& operator=(const LcmTransport&) = delete;

  /// Throws std::runtime_error for a message that does not fit one packet.
  void publish(const std::string& channel, const std::string& bytes) override;
  std::optional<Packet> receive(std::chrono::microseconds timeout) override;
  std::int64_t foreign() const override { return foreign_; }

 private:
  lcm::LCM lcm_;  // sends only: without a subscription it opens no receiver
  std::string channel_, secret_;
  int socket_ = -1;
  std::vector<char> buffer_;
  std::int64_t foreign_ = 0;
};

}  // namespace dipper::transport
