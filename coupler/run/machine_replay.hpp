// The signals of a run with a changed machine: the machine alone, with the recorded wrenches.
#pragma once

#include <filesystem>
#include <vector>

#include "coupler/case/case.hpp"

namespace dipper::run {

/// The case of a run as it was run, with further changes. Its files must still be in their place,
/// or in `case_folder`, a copy of the case ("": the original place). Errors are appended to
/// `findings`.
cases::Case case_of_run(const std::filesystem::path& run, const std::string& case_folder,
                        const std::vector<cases::Override>& changes,
                        std::vector<Finding>& findings);

/// Steps the machine of `changed` with the wrenches in the run's record.h5 and writes the
/// instruments' signals into `out` (observed.hpp). Exact where the dipper's motion does not change
/// (friction, losses); otherwise a first-order result, because the rock does not respond to the
/// changed motion. Masses are those of the run. Throws std::runtime_error for a record that cannot
/// be read, PeerError when the machine fails.
void observe_changed_machine(const std::filesystem::path& run, const cases::Case& changed,
                             const std::filesystem::path& out);

}  // namespace dipper::run
