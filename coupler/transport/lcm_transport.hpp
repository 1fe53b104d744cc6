#pragma once

#include <lcm/lcm-cpp.hpp>
#include <string_view>
#include <vector>

#include "coupler/transport/transport.hpp"

namespace dipper::transport {

/// Multicast group of a run's processes: on this machine, in a network namespace of the run.
inline constexpr const char* kLcmUrl = "udpm://239.255.76.67:7667?ttl=0";

/// The contents of an LCM datagram ("LC02", a number, the channel with its NUL, the message).
/// Fragments are not accepted: our messages fit one packet, and reassembling foreign fragments is a
/// known way to corrupt memory.
std::optional<Packet> read_lcm_packet(std::string_view datagram);

/// LCM over UDP multicast, every message authenticated. ttl=0 in the URL keeps packets on this
/// host. liblcm sends; we receive on our own socket, because liblcm's receiver trusts its input: a
/// channel without its NUL or a fragment with a wrong offset crashes its process.
class LcmTransport final : public Transport {
 public:
  /// Receives `channel`. Throws std::runtime_error, with the remedy when there is no multicast
  /// route.
  LcmTransport(const std::string& url, const std::string& channel, std::string secret);
  ~LcmTransport() override;
  LcmTransport(const LcmTransport&) = delete;
  LcmTransport& operator=(const LcmTransport&) = delete;

  /// Throws std::runtime_error for a message that does not fit one packet.
  void publish(const std::string& channel, const std::string& bytes) override;
  std::optional<Packet> receive(std::chrono::microseconds timeout) override;
  std::int64_t foreign() const override { return foreign_; }

 private:
  lcm::LCM lcm_;  // sends only: without a subscription it creates no receiver
  std::string secret_;
  int socket_ = -1;
  std::vector<char> buffer_;
  std::int64_t foreign_ = 0;
};

}  // namespace dipper::transport
