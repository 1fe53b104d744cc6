#include "coupler/cli/own_network.hpp"

#include <exception>
#include <string>

#include "common/input_error.hpp"
#include "coupler/launch/network.hpp"
#include "coupler/transport/lcm_transport.hpp"

namespace dipper::cli {

bool enter_own_network(Reporter& reporter) {
  if (launch::enter_private_network()) return true;
  reporter.error(
      "the kernel refuses this run a network of its own; it shares the host's. Its messages are "
      "sealed, so nobody can forge them, but all users can read them");
  return false;
}

void check_host_network() try {
  const transport::LcmTransport heard(transport::kLcmUrl, "", "");
} catch (const std::exception& e) {
  throw InputError({{{}, 0, "--mpirun", e.what()}});
}

}  // namespace dipper::cli
