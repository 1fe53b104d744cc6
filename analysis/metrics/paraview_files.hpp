// One file to open in ParaView: particles and walls with their times in seconds.
#pragma once

#include "analysis/io/dump_folder.hpp"

namespace dipper::analysis::metrics {

/// Writes into `folder`: run.pvd, which lists every frame of the particles and of each wall with
/// its time, and paraview/NAME_STEP.vtp for what ParaView's collections cannot hold as it was
/// dumped: walls in the legacy format, particles in text. Particles dumped as .vtp are listed where
/// they are, seen from `final_folder`. A wall without triangles in a frame is left out of it.
/// Throws InputError for a dump, std::runtime_error for a file that cannot be written.
void write_paraview_files(const io::DumpFolder& dumps, const std::filesystem::path& folder,
                          const std::filesystem::path& final_folder);

}  // namespace dipper::analysis::metrics
