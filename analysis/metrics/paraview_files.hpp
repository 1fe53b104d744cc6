// One file for ParaView: particles, walls and the machine with their times in seconds.
#pragma once

#include "analysis/io/dump_folder.hpp"
#include "analysis/run/figure.hpp"

namespace dipper::analysis::metrics {

/// Writes into `folder`: run.pvd, which lists every frame of the particles, of each wall and of the
/// figure with its time; and paraview/NAME_STEP.vtp: the particles with their rock (ParticleFiles),
/// and the walls, since ParaView's collections do not support the format of LIGGGHTS's wall dumps.
/// A wall without triangles in a frame is left out of it. Throws InputError for a dump,
/// std::runtime_error for a file that cannot be written.
void write_paraview_files(const run::RunData& run, const io::DumpFolder& dumps,
                          const run::Figure& figure, const std::filesystem::path& folder);

}  // namespace dipper::analysis::metrics
