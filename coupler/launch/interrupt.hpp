#pragma once

#include <stdexcept>

namespace dipper::launch {

/// The user wants out now, without another checkpoint.
struct Interrupted : std::runtime_error {
  Interrupted() : std::runtime_error("interrupted") {}
};

/// From here on SIGINT, SIGTERM and SIGHUP (a closed terminal) are counted instead of ending the
/// program, and SIGPIPE is ignored.
void catch_interrupts();

/// How many have come: one asks for an orderly end, two for an immediate one.
int interrupts();

}  // namespace dipper::launch
