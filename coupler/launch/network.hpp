#pragma once

namespace dipper::launch {

/// Gives this process, and all it starts, a network of its own: a loopback device that routes LCM's
/// multicast. No other process on the machine receives its messages, and no route is needed.
/// Works unprivileged on Debian. Must be called before any thread is started.
/// \return false where the kernel does not allow it; the run then uses the host's network.
bool enter_private_network();

}  // namespace dipper::launch
