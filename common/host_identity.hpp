// The host and the network namespace of a process.
#pragma once

#include <string>

namespace dipper {

/// For messages.
std::string host_name();

/// The same for two processes if and only if they share a network: this boot of the kernel and the
/// network namespace. Each then receives what the other sends to the loopback device.
std::string network_identity();

}  // namespace dipper
