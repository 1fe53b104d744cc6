#pragma once

#include <stdexcept>

namespace dipper::launch {

/// Thrown when the user asks for an immediate end, without another checkpoint.
struct Interrupted : std::runtime_error {
  Interrupted() : std::runtime_error("interrupted") {}
};

/// After this call SIGINT, SIGTERM and SIGHUP (a closed terminal) are counted and do not end the
/// program; SIGPIPE is ignored.
void catch_interrupts();

/// Signals received: one asks for an orderly end, two for an immediate one.
int interrupts();

}  // namespace dipper::launch
