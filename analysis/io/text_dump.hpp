// LAMMPS text dumps: `dump custom` of LIGGGHTS and LAMMPS.
#pragma once

#include "analysis/io/dump_reader.hpp"

namespace dipper::analysis::io {

/// The frames of a file, in its order. Throws InputError, also for a frame that was cut short.
std::vector<DumpFrame> index_text_dump(const std::filesystem::path& file);

/// As DumpReader::read; `columns` are names of the file's own columns.
void read_text_dump(const DumpFrame& frame, const std::vector<std::string>& columns,
                    const std::function<void(const ParticleChunk&)>& visit);

}  // namespace dipper::analysis::io
