// `dipper run` as a whole.
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
/// finds or settles the pile, starts both sides, steps them to the end, writes the summary. Errors
/// during the run are caught here and reported. Does nothing to a complete run. \param program
/// drives the machine; the case must allow it (require_operable)
RunStatus paired_run(const cases::Case& c, const result::RunFolder& folder, bool resume,
                     const launch::MpiPlaces& places,
                     const std::optional<operate::Program>& program, Reporter& reporter);

}  // namespace dipper::run
