#pragma once

#include <lcm/lcm-cpp.hpp>
#include <memory>

#include "coupler/transport/transport.hpp"

namespace dipper::transport {

/// A transport that also writes every message, both ways, to an LCM log file: what lcm-logplayer
/// plays and `dipper replay` reads. Several may share one log.
class LoggedTransport final : public Transport {
 public:
  LoggedTransport(std::unique_ptr<Transport> transport, std::shared_ptr<lcm::LogFile> log)
      : transport_(std::move(transport)), log_(std::move(log)) {}
  void publish(const std::string& channel, const std::string& bytes) override;
  std::optional<Packet> receive(std::chrono::microseconds timeout) override;
  std::int64_t foreign() const override { return transport_->foreign(); }

 private:
  void write(const std::string& channel, const std::string& bytes);
  std::unique_ptr<Transport> transport_;
  std::shared_ptr<lcm::LogFile> log_;
};

}  // namespace dipper::transport
