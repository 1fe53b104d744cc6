// Whether a resumed run is still the same run.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "coupler/case/case.hpp"

namespace dipper::run {

/// Writes the run's identity into its folder: case.txt; inputs.sha256, with the SHA-256 of every
/// file that the case names, in the format of `sha256sum -c` in the case's folder; and copies of
/// its motion (motion.csv) and machine data (machine.yaml).
void write_identity(const std::filesystem::path& folder, const cases::Case& c);

/// The differences of `c` from the run in `folder`, one line for each key or file. A resumed run
/// may end later, write more often and wait longer; everything else must be unchanged. Its motion
/// may differ after `from_s`, where the run continues: so the next pass can be planned on the face
/// as it is then.
std::vector<std::string> changed_since(const std::filesystem::path& folder, const cases::Case& c,
                                       double from_s);

}  // namespace dipper::run
