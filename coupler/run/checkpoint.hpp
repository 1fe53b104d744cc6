// Checkpoints: what a run can be resumed from.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "coupler/core/coupling.hpp"
#include "coupler/result/run_cost.hpp"
#include "coupler/run/run_record.hpp"

namespace dipper::run {

/// One folder under checkpoints/; it appears there only when it is complete.
struct Checkpoint {
  std::filesystem::path folder;
  core::CouplingState coupling;
  RecordPosition record;
  result::RunCost cost;
  nlohmann::json desk;  ///< state of the planning operator (pass_desk.hpp); null without one

  std::filesystem::path rock() const { return folder / "rock.restart"; }
  std::filesystem::path machine() const { return folder / "machine.state"; }
};

/// Has both sides save, adds coupling.json, writes the manifest (common/manifest.hpp) and moves the
/// folder into place; keeps the last older checkpoint and removes the others. Returns it with
/// `folder` set.
Checkpoint save_checkpoint(const std::filesystem::path& checkpoints, Checkpoint c, core::Rock& rock,
                           core::Machine& machine);

/// The newest checkpoint whose files agree with its manifest; none if there are no checkpoints.
/// Damaged newer ones are renamed, each with a warning that names the file. Throws InputError, and
/// renames nothing, when there are checkpoints and all are damaged: continuing would lose the run.
std::optional<Checkpoint> last_checkpoint(const std::filesystem::path& checkpoints);

}  // namespace dipper::run
