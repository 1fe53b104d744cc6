// Which host, and which of its networks, a process is in.
#pragma once

#include <string>

namespace dipper {

/// For messages.
std::string host_name();

/// The same for two processes if and only if they share a network: this boot of the kernel and the
/// network namespace. What one sends to the loopback device the other then hears.
std::string network_identity();

}  // namespace dipper
