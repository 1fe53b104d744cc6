#pragma once

#include <string>

#include "coupler/transport/transport.hpp"

namespace dipper::transport {

// Authentication of messages: each carries in `header.mac` the HMAC-SHA256 of its channel and bytes
// under the run's secret. A message with a wrong code is dropped before it is decoded. The secret
// itself is never sent. Repeated messages are recognised by their request number, not here.

/// Sets `header.mac` of an encoded message.
void seal(const std::string& secret, Packet& packet);

/// Whether the code is right; sets `header.mac` to zero, as it was before `seal`.
bool unseal(const std::string& secret, Packet& packet);

}  // namespace dipper::transport
