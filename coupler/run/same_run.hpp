// Whether a run that goes on is still the same run.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "coupler/case/case.hpp"

namespace dipper::run {

/// Writes what the run is into its folder: case.txt, and in inputs.sha256 the SHA-256 of every file
/// the case names, as `sha256sum -c` reads it in the case's folder; and copies of its motion
/// (motion.csv) and its machine's data (machine.yaml).
void write_identity(const std::filesystem::path& folder, const cases::Case& c);

/// What in `c` is not as in the run that `folder` holds, a line a key or file: a run that goes on
/// may end later, write more often and wait longer, but must be the same run otherwise. Its motion
/// may be another one after `from_s`, where the run goes on: the next pass can be planned from the
/// face as it stands then.
std::vector<std::string> changed_since(const std::filesystem::path& folder, const cases::Case& c,
                                       double from_s);

}  // namespace dipper::run
