// The replay of a run without rock: its walls from the record alone, over the bench before the dig.
#pragma once

#include "analysis/report/dump_replay.hpp"

namespace dipper::analysis::report {

/// Five frames a second.
class RecordReplay : public ReplaySource {
 public:
  /// The walls of replay_walls, and "bench". `run` must outlive this. Throws InputError
  /// naming the bench's file when it cannot be read.
  explicit RecordReplay(const run::RunData& run);

  const std::vector<ReplayWall>& walls() const override { return walls_; }
  const std::vector<double>& times_s() const override { return times_s_; }
  void read(std::size_t index, ReplayFrame& frame, const Keep& keep) const override;

 private:
  std::vector<ReplayWall> walls_;
  std::vector<std::function<BodyState(double)>> states_;
  std::vector<double> times_s_;
};

}  // namespace dipper::analysis::report
