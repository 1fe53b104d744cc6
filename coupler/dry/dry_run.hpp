// The machine alone, in seconds: tries a motion before rock is computed.
#pragma once

#include <optional>

#include "common/reporter.hpp"
#include "coupler/case/case.hpp"
#include "coupler/result/run_folder.hpp"
#include "coupler/run/paired_run.hpp"

namespace dipper::dry {

enum class RockModel {
  none,     ///< the machine moves in air
  estimate  ///< EstimatedRock
};

/// Throws InputError for a case whose machine has no drives (machine.kind poses).
void require_drives(const cases::Case& c);

/// Runs the machine's process through the case's motion and writes record.h5 and summary.json, of
/// which `dipper report` makes a page. Reports the passes and any exceeded limits of the machine.
/// An interrupted run cannot be resumed. \param program  drives the machine in place of the motion.
/// Throws InputError.
run::RunStatus dry_run(const cases::Case& c, RockModel rock, const result::RunFolder& folder,
                       const std::optional<operate::Program>& program, Reporter& reporter);

}  // namespace dipper::dry
