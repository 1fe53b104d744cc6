#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "common/record/record.hpp"
#include "coupler/run/observer.hpp"

namespace dipper::run {

/// The length of a record; part of a checkpoint.
struct RecordPosition {
  std::size_t rows = 0;
  std::int64_t t_ns = 0;                       ///< of the last row
  double rock_work_J = 0, machine_work_J = 0;  ///< sums over all windows
};

/// record.h5 of a run: one row a sync step, from the start. Datasets: time_s, step_index, sync_s;
/// machine/NAME and rock/NAME for the sides' channels; bodies/BODY/{pose, twist, wrench_mean,
/// wrench_end, wall_pose}; coupling/{rock_work, machine_work, energy_residual, interface_power_*}.
class RunRecord final : public Observer {
 public:
  /// A new record, or (from.rows > 0) an earlier one of the run, truncated to that length.
  RunRecord(const std::filesystem::path& file, const core::ServerInfo& machine,
            const core::ServerInfo& rock, const std::map<std::string, std::string>& attributes,
            const RecordPosition& from);

  /// Adds a row; it is on disk about a second later.
  void window(const core::Window& w) override;
  void flush();
  void sync();  ///< flushes, and to the disk itself
  const RecordPosition& position() const { return at_; }

 private:
  struct BodyChannels {
    std::size_t pose, twist, wrench_mean, wrench_end, wall_pose;
  };
  record::Record record_;
  std::size_t time_, step_, sync_, rock_work_, machine_work_, residual_, power_rock_,
      power_machine_;
  std::vector<std::size_t> machine_, rock_;
  std::vector<BodyChannels> bodies_;
  RecordPosition at_;
  std::chrono::steady_clock::time_point flushed_;
};

}  // namespace dipper::run
