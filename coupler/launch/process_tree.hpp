// CPU time of processes that are still at work.
#pragma once

#include <sys/types.h>

namespace dipper::launch {

/// CPU time [s] of a process, of all that it has started and that still runs, and of those of them
/// that have ended and were waited for. 0 when there is no such process.
double tree_cpu_s(pid_t root);

}  // namespace dipper::launch
