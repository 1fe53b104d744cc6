#pragma once

#include <lcm/lcm-cpp.hpp>
#include <set>
#include <vector>

#include "coupler/transport/transport.hpp"

namespace dipper::transport {

/// LCM over UDP multicast. ttl=0 in the URL keeps packets on this host. liblcm sends; we receive on
/// a socket of our own, since liblcm's receiver trusts what comes in: a channel without its NUL or
/// a fragment with a wild offset is the end of its process.
class LcmTransport final : public Transport {
 public:
  /// `url` as "udpm://239.255.76.67:7667?ttl=0". Throws std::runtime_error, with the cure when
  /// there is no multicast route.
  LcmTransport(const std::string& url, const std::set<std::string>& channels);
  ~LcmTransport() override;
  LcmTransport(const LcmTransport&) = delete;
  LcmTransport& operator=(const LcmTransport&) = delete;

  /// Throws std::runtime_error for a message that does not fit one packet.
  void publish(const std::string& channel, const std::string& bytes) override;
  std::optional<Packet> receive(std::chrono::microseconds timeout) override;
  std::int64_t foreign() const override { return foreign_; }

 private:
  lcm::LCM lcm_;  // sends only: without a subscription it opens no receiver
  std::set<std::string> channels_;
  int socket_ = -1;
  std::vector<char> buffer_;
  std::int64_t foreign_ = 0;
};

}  // namespace dipper::transport
