#pragma once

#include <filesystem>

namespace dipper::launch {

/// Where mpirun and its ranks keep their session files and shared memory, some 20 MB that stay
/// behind when they are killed: a folder of this process alone, made at the first call and removed
/// when the process ends. What launchers that were killed have left is removed at that call too.
/// Throws std::runtime_error when it cannot be made.
const std::filesystem::path& mpi_scratch();

}  // namespace dipper::launch
