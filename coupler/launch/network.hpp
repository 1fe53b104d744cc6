#pragma once

namespace dipper::launch {

/// Gives this process, and all it starts, a network of its own: a loopback device that routes LCM's
/// multicast. Nobody else on the machine hears the run, and no route has to be set up by hand.
/// Works unprivileged on Debian. Must be called before any thread is started.
/// \return false where the kernel does not allow it; the host's own route then has to do.
bool enter_private_network();

}  // namespace dipper::launch
