#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "common/record/record.hpp"
#include "coupler/core/coupling.hpp"

namespace dipper::run {

/// record.h5 of a run: one row a sync step, from the start. Datasets: time_s, step_index, sync_s;
/// machine/NAME and rock/NAME for the sides' channels; bodies/BODY/{pose, twist, wrench_mean,
/// wrench_end, wall_pose}; coupling/{rock_work, machine_work, energy_residual, interface_power_*}.
class RunRecord {
 public:
  /// A new record, or (rows > 0) the continuation of an earlier leg's, cut back to `rows`.
  RunRecord(const std::filesystem::path& file, const core::ServerInfo& machine,
            const core::ServerInfo& rock, const std::map<std::string, std::string>& attributes,
            std::size_t rows);

  void put(const core::Window& w);
  void flush() { record_.flush(); }
  std::size_t rows() const { return record_.rows(); }

  /// Sum over all windows, earlier legs included [J].
  double interface_work_J() const { return rock_work_J_; }
  double energy_residual_J() const { return machine_work_J_ - rock_work_J_; }

  /// Continues the sums of an earlier leg that ended at time_s.
  void resume_at(double time_s, double rock_work_J, double machine_work_J);
  double machine_work_J() const { return machine_work_J_; }

 private:
  struct BodyChannels {
    std::size_t pose, twist, wrench_mean, wrench_end, wall_pose;
  };
  record::Record record_;
  std::size_t time_, step_, sync_, rock_work_, machine_work_, residual_, power_rock_,
      power_machine_;
  std::vector<std::size_t> machine_, rock_;
  std::vector<BodyChannels> bodies_;
  double last_time_s_ = 0, rock_work_J_ = 0, machine_work_J_ = 0;
};

}  // namespace dipper::run
