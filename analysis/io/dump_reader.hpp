// Particle dumps of LIGGGHTS and LAMMPS, read in chunks: memory is bounded for any size
// (kept_rows.hpp).
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/box.hpp"

namespace dipper::analysis::io {

class KeptRows;

/// One frame of a dump, from its header.
struct DumpFrame {
  std::int64_t step = 0;
  std::optional<double> time_s;  ///< if the dump has it (ITEM: TIME)
  std::filesystem::path file;
  long line = 0;            ///< of its column names, or of its points
  std::int64_t offset = 0;  ///< of its first row (text)
  std::size_t particles = 0;
  std::optional<Box> box;
  bool tilted = false;  ///< the box: then scaled positions (xs) do not follow from its bounds
  std::vector<std::string> columns;
  std::shared_ptr<KeptRows> kept;  ///< of the reader's text frames (text)

  bool has(const std::string& column) const;
};

/// Some particles of a frame: columns[k][i] is the k-th requested column of particle i.
struct ParticleChunk {
  std::size_t rows = 0;
  std::vector<std::vector<double>> columns;
};

constexpr std::size_t kChunkRows = 16384;

/// The frames of one or more dump files, by step. Formats, by the file's extension:
///   .vtp, .vtk   `dump custom/vtk`: XML (ascii, or binary without compression), or legacy (ascii,
///                binary). The step is the last number of the file's name. A vector is three
///                columns: v is vx, vy, vz; the points are x, y, z.
///   any other    `dump custom`: text, one frame or several in a file.
/// Opening reads every header and skips over the rows. Throws InputError naming file and line: no
/// dump, a file that was cut short, two frames of one step.
class DumpReader {
 public:
  explicit DumpReader(const std::vector<std::filesystem::path>& files);

  const std::vector<DumpFrame>& frames() const { return frames_; }

  /// Passes a frame's rows to `visit`, up to kChunkRows at a time, in the file's order. Positions
  /// requested as x, y, z are made from xu or xs when the dump has only those, a radius from a
  /// diameter. Throws InputError naming file and line: a missing column, a row that is too short,
  /// not a number.
  static void read(const DumpFrame& frame, const std::vector<std::string>& columns,
                   const std::function<void(const ParticleChunk&)>& visit);

 private:
  std::vector<DumpFrame> frames_;
};

/// A file's name without the .gz of a gzipped one.
std::filesystem::path without_gz(std::filesystem::path file);

/// The last whole number in a file's name: rocks_1670.vtp is 1670, and so is rocks_1670.dump.gz.
std::optional<std::int64_t> step_in_name(const std::filesystem::path& file);

}  // namespace dipper::analysis::io
