#pragma once

#include <memory>
#include <string>

#include "coupler/transport/transport.hpp"

namespace dipper::transport {

/// A transport on which only those who know the run's secret are heard. Each message leaves with
/// the HMAC-SHA256 of its channel and its bytes in `header.mac`, and one that comes without the
/// right one is dropped before anything decodes it. The secret itself is never sent; that a message
/// is not heard twice is the business of core::Requester and core::Responder, which number them.
class SealedTransport final : public Transport {
 public:
  SealedTransport(std::unique_ptr<Transport> transport, std::string secret)
      : transport_(std::move(transport)), secret_(std::move(secret)) {}
  /// `bytes` as `encode` makes them.
  void publish(const std::string& channel, const std::string& bytes) override;
  /// With `header.mac` zero again, as it was before it was sealed.
  std::optional<Packet> receive(std::chrono::microseconds timeout) override;
  std::int64_t foreign() const override { return foreign_ + transport_->foreign(); }

 private:
  std::unique_ptr<Transport> transport_;
  std::string secret_;
  std::int64_t foreign_ = 0;
};

/// 256 random bits, as hex digits. Throws std::runtime_error when the kernel has none to give.
std::string random_secret();

/// Where the processes of a run meet: on this machine, in a network of the run's own.
inline constexpr const char* kLcmUrl = "udpm://239.255.76.67:7667?ttl=0";

/// LCM at `url`, sealed with `secret`, that hears `channel`: how the processes of a run speak.
std::unique_ptr<Transport> sealed_lcm(const std::string& url, const std::string& secret,
                                      const std::string& channel);

}  // namespace dipper::transport
