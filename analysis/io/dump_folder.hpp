// The dumps of a run, or of a folder that LIGGGHTS filled without Dipper.
#pragma once

#include <map>

#include "analysis/io/dump_reader.hpp"

namespace dipper::analysis::io {

struct DumpFolder {
  std::filesystem::path folder;   ///< the folder of the dumps
  std::string particles;          ///< the files' common name: "rocks"
  std::vector<DumpFrame> frames;  ///< of the particles, by step
  std::vector<double> time_s;     ///< of each frame
  double timestep_s = 0;
  /// Wall dumps (VTK with polygons) by name, then by step.
  std::map<std::string, std::map<std::int64_t, std::filesystem::path>> walls;

  /// The frame nearest to a time. There always is one.
  std::size_t nearest(double time_s) const;
  /// Whether every frame has the velocities of its particles.
  bool has_velocities() const;
};

/// Opens FOLDER/dumps when that is a folder, else FOLDER. Particles are the text dumps; without
/// any, the VTK files that have points but no polygons. Two sets of particles: the one named rocks,
/// else an error.
///
/// Times are step * timestep: `timestep_s` when given; else FOLDER/case.txt's dem.timestep_s; else
/// that of a *.series; else the dumps' own times (ITEM: TIME).
///
/// Throws InputError naming file and line: no dumps, an unknown time step, a frame that is missing
/// (from an even spacing of steps, from a *.series, from one kind of dump but not the others), a
/// file whose step is not the one in its name, a time step that the dumps' own times contradict by
/// more than 1 %, and the errors of DumpReader.
DumpFolder open_dump_folder(const std::filesystem::path& folder,
                            std::optional<double> timestep_s = {});

}  // namespace dipper::analysis::io
