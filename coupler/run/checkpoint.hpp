// Where a run can go on from.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "coupler/core/coupling.hpp"
#include "coupler/result/run_cost.hpp"
#include "coupler/run/run_record.hpp"

namespace dipper::run {

/// One folder under checkpoints/, whole or not there at all.
struct Checkpoint {
  std::filesystem::path folder;
  core::CouplingState coupling;
  RecordPosition record;
  result::RunCost cost;
  nlohmann::json desk;  ///< of an operator who plans (pass_desk.hpp); null: there is none

  std::filesystem::path rock() const { return folder / "rock.restart"; }
  std::filesystem::path machine() const { return folder / "machine.state"; }
};

/// Has both sides save, then adds coupling.json, seals the folder (common/manifest.hpp) and moves
/// it into place; older checkpoints but the last are removed. Returns it with `folder` set.
Checkpoint save_checkpoint(const std::filesystem::path& checkpoints, Checkpoint c, core::Rock& rock,
                           core::Machine& machine);

/// The newest checkpoint whose files are what was written; none when there never was one. Newer
/// ones are set aside, each with a warning that names the file. Throws InputError, and leaves all
/// where it is, when there are checkpoints and none of them is sound: what the run got to would be
/// lost.
std::optional<Checkpoint> last_checkpoint(const std::filesystem::path& checkpoints);

}  // namespace dipper::run
