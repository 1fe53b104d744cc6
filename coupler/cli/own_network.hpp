// A run's network of its own.
#pragma once

#include "common/reporter.hpp"

namespace dipper::cli {

/// launch::enter_private_network; says so aloud where the kernel refuses.
void enter_own_network(Reporter& reporter);

}  // namespace dipper::cli
