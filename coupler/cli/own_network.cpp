#include "coupler/cli/own_network.hpp"

#include "coupler/launch/network.hpp"

namespace dipper::cli {

void enter_own_network(Reporter& reporter) {
  if (launch::enter_private_network()) return;
  reporter.error(
      "the kernel refuses this run a network of its own; it shares the host's. Its messages are "
      "sealed, so nobody can speak in them, but all users can read them");
}

}  // namespace dipper::cli
