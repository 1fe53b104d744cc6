#pragma once

#include <lcm/lcm-cpp.hpp>
#include <queue>
#include <vector>

#include "coupler/transport/transport.hpp"

namespace dipper::transport {

/// LCM over UDP multicast. ttl=0 in the URL keeps packets on this host.
class LcmTransport final : public Transport {
 public:
  /// Throws std::runtime_error with the cure when there is no multicast route.
  LcmTransport(const std::string& url, const std::vector<std::string>& channels);
  void publish(const std::string& channel, const std::string& bytes) override;
  std::optional<Packet> receive(std::chrono::milliseconds timeout) override;

 private:
  void on_message(const lcm::ReceiveBuffer* buffer, const std::string& channel);
  lcm::LCM lcm_;
  std::queue<Packet> inbox_;
};

}  // namespace dipper::transport
