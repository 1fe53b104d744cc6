#pragma once

#include <filesystem>
#include <functional>

#include "coupler/core/message.hpp"
#include "coupler/transport/transport.hpp"

namespace dipper::transport {

/// Executes one request; returns the reply's body. Throws what the side throws.
core::Body answer(core::Machine& machine, const core::Message& request);
core::Body answer(core::Rock& rock, const core::Message& request);

/// Answers the requests that `transport` receives, on the channel `out`, until "stop". An exception
/// from `handle` is sent to the other side as a failed status and then thrown to the caller; so is
/// a request to save or load outside the folder `checkpoints`.
void serve(Transport& transport, const std::string& out, const std::filesystem::path& checkpoints,
           const std::function<core::Body(const core::Message&)>& handle);

}  // namespace dipper::transport
