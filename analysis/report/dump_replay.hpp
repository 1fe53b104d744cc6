// The replay of a dump folder, with or without walls.
#pragma once

#include <functional>

#include "analysis/dump_folder.hpp"
#include "analysis/report/replay_source.hpp"

namespace dipper {

/// A wall and where it is when.
struct MovingWall {
  ReplayWall wall;
  std::function<BodyState(double time_s)> state;
};

/// The walls of a run of Dipper: those in its record, with the meshes of its first wall dump put
/// back into their own frames, and the others of its dumps, which stand still. Throws what the
/// record's and the dump's readers throw.
std::vector<MovingWall> walls_of_run(const std::filesystem::path& record, const DumpFolder& dumps);

/// Needs the columns id, x, y, z and radius; type, id_multisphere and vx, vy, vz when they are
/// there.
class DumpReplay : public ReplaySource {
 public:
  DumpReplay(const DumpFolder& dumps, std::vector<MovingWall> walls);

  const std::vector<ReplayWall>& walls() const override { return walls_; }
  const std::vector<double>& times_s() const override { return dumps_.time_s; }
  void read(std::size_t index, ReplayFrame& frame) const override;

 private:
  const DumpFolder& dumps_;
  std::vector<ReplayWall> walls_;
  std::vector<std::function<BodyState(double)>> states_;
};

}  // namespace dipper
