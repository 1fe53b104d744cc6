// The machine's process by itself.
#pragma once

#include <filesystem>
#include <memory>

#include "coupler/launch/process.hpp"
#include "coupler/setup/peer_config.hpp"
#include "coupler/transport/lcm_transport.hpp"
#include "coupler/transport/remote.hpp"

namespace dipper::run {

/// A shovel in a process of its own, for as long as this lives. Who waits for it also watches it:
/// when it ends, transport::PeerError says what it said last; at the second interrupt
/// launch::Interrupted is thrown.
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
