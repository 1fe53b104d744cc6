#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "coupler/core/coupling.hpp"
#include "dem/rock_setup.hpp"

namespace dipper::run {

/// Where a run can go on from: one folder under checkpoints/, whole or not there at all.
struct Checkpoint {
  std::filesystem::path folder;
  std::int64_t step_index = 0;
  std::int64_t dem_step = 0;
  std::vector<Wrench> held;             ///< by the machine, into the next window
  std::vector<Pose> X_WB_wall;          ///< the walls as LIGGGHTS has them
  std::vector<dem::WallMemory> memory;  ///< of the walls
  std::size_t record_rows = 0;
  double rock_work_J = 0, machine_work_J = 0;
  double dem_cpu_s = 0, mbs_cpu_s = 0;

  std::filesystem::path rock() const { return folder / "rock.restart"; }
  std::filesystem::path machine() const { return folder / "machine.state"; }
};

/// Has both sides save, then adds coupling.json, seals the folder (common/manifest.hpp) and moves
/// it into place; older checkpoints but the last are removed. Returns it with `folder` set.
Checkpoint save_checkpoint(const std::filesystem::path& checkpoints, Checkpoint c, core::Rock& rock,
                           core::Machine& machine);

/// The newest checkpoint whose files are what was written, if any. Newer ones are set aside, each
/// with a warning that names the file.
std::optional<Checkpoint> last_checkpoint(const std::filesystem::path& checkpoints);

}  // namespace dipper::run
