// A frame's rock as a file for ParaView.
#pragma once

#include "analysis/io/dump_reader.hpp"
#include "analysis/rock/rock_tags.hpp"
#include "analysis/run/run_folder.hpp"

namespace dipper::analysis::metrics {

/// Writes frames of one run as .vtp: every sphere with its dumped columns, and with `rock`, `size`,
/// `in_dipper` if the dipper's load is known, `shape` if the deck is.
class ParticleFiles {
 public:
  /// `run` must outlive this. Throws as rock::read_shapes does.
  explicit ParticleFiles(const run::RunData& run);

  /// Throws as rock::tag_rocks and io::VtpWriter do.
  void write(const io::DumpFrame& frame, double time_s, const std::filesystem::path& to) const;

 private:
  const run::RunData& run_;
  std::vector<rock::ShapeRadii> shapes_;
};

}  // namespace dipper::analysis::metrics
