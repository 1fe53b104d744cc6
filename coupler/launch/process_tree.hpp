// CPU time of running processes.
#pragma once

#include <sys/types.h>

namespace dipper::launch {

/// CPU time [s] of a process, of its descendants that still run, and of those that have ended and
/// were waited for. 0 when there is no such process.
double tree_cpu_s(pid_t root);

}  // namespace dipper::launch
