// `dipper run` from its first line to its last.
#pragma once

#include <optional>

#include "common/reporter.hpp"
#include "coupler/case/case.hpp"
#include "coupler/launch/mpirun.hpp"
#include "coupler/operate/program.hpp"
#include "coupler/result/run_folder.hpp"

namespace dipper::run {

/// How a run ended; the value is the program's exit status (design: Commands).
enum class RunStatus { complete = 0, failed = 3, interrupted = 4 };

/// Runs a checked case in its folder, from the start or, with `resume`, from the last checkpoint:
/// settles or finds the pile, starts both sides, steps them to the end, writes the summary. What
/// fails on the way ends here and is told to the reporter. A run that is complete already is left
/// as it is. \param program  that drives the machine, of a case that it can (require_operable)
RunStatus paired_run(const cases::Case& c, const result::RunFolder& folder, bool resume,
                     const launch::MpiPlaces& places,
                     const std::optional<operate::Program>& program, Reporter& reporter);

}  // namespace dipper::run
