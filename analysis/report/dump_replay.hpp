// The replay of a dump folder, with or without walls.
#pragma once

#include <functional>

#include "analysis/io/dump_folder.hpp"
#include "analysis/report/replay_source.hpp"
#include "analysis/run/run_folder.hpp"

namespace dipper::analysis::report {

/// A wall and its poses against time.
struct MovingWall {
  ReplayWall wall;
  std::function<BodyState(double time_s)> state;
};

/// The walls of a run, or of dumps with a mesh and poses: dipper and door on their tracks, the
/// truck at its place. `run` must outlive them.
std::vector<MovingWall> replay_walls(const run::RunData& run);

/// Walls have the fields of their dumps for each triangle, except its number.
///
/// Needs the columns id, x, y, z and radius; type, id_multisphere and vx, vy, vz are
/// optional.
class DumpReplay : public ReplaySource {
 public:
  DumpReplay(const io::DumpFolder& dumps, std::vector<MovingWall> walls);

  const std::vector<ReplayWall>& walls() const override { return walls_; }
  const std::vector<double>& times_s() const override { return dumps_.time_s; }
  void read(std::size_t index, ReplayFrame& frame, const Keep& keep) const override;

 private:
  void read_walls(std::int64_t step, ReplayFrame& frame) const;

  const io::DumpFolder& dumps_;
  std::vector<ReplayWall> walls_;
  std::vector<std::function<BodyState(double)>> states_;
};

}  // namespace dipper::analysis::report
