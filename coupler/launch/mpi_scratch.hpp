#pragma once

#include <filesystem>

namespace dipper::launch {

/// The folder for the session files and shared memory of mpirun and its ranks, some 20 MB that
/// remain when they are killed. It belongs to this process alone, is made at the first call and
/// removed when the process ends. The first call also removes folders of killed launchers.
/// Throws std::runtime_error when it cannot be made.
const std::filesystem::path& mpi_scratch();

}  // namespace dipper::launch
