// A run's network of its own.
#pragma once

#include "common/reporter.hpp"

namespace dipper::cli {

/// launch::enter_private_network; where the kernel refuses, reports it and returns false.
bool enter_own_network(Reporter& reporter);

/// Whether this host's own network carries a run's messages, as one whose ranks are on several
/// hosts needs it. Throws InputError that names --mpirun and the remedy.
void check_host_network();

}  // namespace dipper::cli
