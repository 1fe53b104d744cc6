#pragma once

#include <string>

#include "coupler/transport/transport.hpp"

namespace dipper::transport {

// A message leaves with the HMAC-SHA256 of its channel and its bytes under the run's secret in
// `header.mac`; one that comes without the right one is dropped before anything decodes it. The
// secret itself is never sent. That a message is not heard twice is for its number to see to.

/// Sets `header.mac` of a message as `encode` makes it.
void seal(const std::string& secret, Packet& packet);

/// Whether the seal is right; `header.mac` is zero then, as before it was sealed.
bool unseal(const std::string& secret, Packet& packet);

}  // namespace dipper::transport
