// The machine's process without a rock side.
#pragma once

#include <filesystem>
#include <memory>

#include "coupler/launch/process.hpp"
#include "coupler/setup/peer_config.hpp"
#include "coupler/transport/lcm_transport.hpp"
#include "coupler/transport/remote.hpp"

namespace dipper::run {

/// Starts dipper-mbs for a shovel and ends it in the destructor. Waiting for an answer also watches
/// the process: if it ends, transport::PeerError gives its last message; the second interrupt
/// throws launch::Interrupted.
class LoneMachine {
 public:
  /// Writes mbs.json and mbs.log into `folder`.
  LoneMachine(const setup::PeerConfig& config, const std::filesystem::path& folder);
  ~LoneMachine();
  LoneMachine(const LoneMachine&) = delete;
  LoneMachine& operator=(const LoneMachine&) = delete;

  core::Machine& machine() { return machine_; }
  double cpu_s() const { return process_.cpu_s(); }

 private:
  transport::LinkOptions options();

  std::filesystem::path log_;
  launch::Process process_;
  transport::LcmTransport transport_;
  transport::Link link_;
  transport::RemoteMachine machine_;
};

}  // namespace dipper::run
