#pragma once

#include <functional>

#include "coupler/core/protocol.hpp"
#include "coupler/core/server.hpp"
#include "coupler/transport/peer_config.hpp"
#include "coupler/transport/transport.hpp"

namespace dipper::transport {

/// What a side does with one request; the reply's body. Throws what the side throws.
core::Body answer(core::Machine& machine, const core::Message& request);
core::Body answer(core::Rock& rock, const core::Message& request);

/// Answers requests on `in` with replies on `out` until "stop" or until `alive` says no.
/// An exception from `handle` goes to the other side as a failed status and then to the caller, and
/// so does a request to save or load outside of config.checkpoints.
void serve(
    Transport& transport, const std::string& in, const std::string& out, const PeerConfig& config,
    const std::function<core::Body(const core::Message&)>& handle,
    const std::function<bool()>& alive = [] { return true; });

}  // namespace dipper::transport
