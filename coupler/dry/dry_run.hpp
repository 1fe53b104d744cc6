// The machine alone, in seconds: a path tried before rock is computed.
#pragma once

#include <optional>

#include "common/reporter.hpp"
#include "coupler/case/case.hpp"
#include "coupler/result/run_folder.hpp"
#include "coupler/run/paired_run.hpp"

namespace dipper::dry {

enum class RockModel {
  none,     ///< the machine moves in the air
  estimate  ///< as EstimatedRock
};

/// Throws InputError for a case whose machine has no drives to try (machine.kind poses).
void require_drives(const cases::Case& c);

/// Runs the machine's process through the case's motion and leaves record.h5 and summary.json,
/// which `dipper report` makes a page of. Tells the passes, and what of the machine's limits was
/// reached. A run that was interrupted cannot go on: it is begun anew. \param program  that drives
/// the machine in place of the motion. Throws InputError.
run::RunStatus dry_run(const cases::Case& c, RockModel rock, const result::RunFolder& folder,
                       const std::optional<operate::Program>& program, Reporter& reporter);

}  // namespace dipper::dry
