// What a run would have shown with another machine: the machine alone, against the recorded rock.
#pragma once

#include <filesystem>
#include <vector>

#include "coupler/case/case.hpp"

namespace dipper::run {

/// The case of a run as it ran, with further changes. The files it names must still be there, or in
/// `case_folder`, the same case at another place ("": where it was). Errors are appended to
/// `findings`.
cases::Case case_of_run(const std::filesystem::path& run, const std::string& case_folder,
                        const std::vector<cases::Override>& changes,
                        std::vector<Finding>& findings);

/// Steps the machine of `changed` with the wrenches in the run's record.h5 and writes what the
/// mine's instruments would have shown into `out` (observed.hpp). Exact where the dipper's motion
/// stays as it was (friction, losses); else the first-order answer, as the rock does not see the
/// difference. Masses are the run's. Throws std::runtime_error for a record that cannot be read,
/// PeerError when the machine fails.
void observe_changed_machine(const std::filesystem::path& run, const cases::Case& changed,
                             const std::filesystem::path& out);

}  // namespace dipper::run
