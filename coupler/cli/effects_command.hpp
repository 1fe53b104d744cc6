#pragma once

#include <filesystem>
#include <iosfwd>

namespace dipper::cli {

/// Writes the effects a case can take, the catalogue's and its own, as JSON; docs/case.md has the
/// format. Returns the exit status: 0, or 2 with every fault of their files on stderr and nothing
/// written.
int effects_command(const std::filesystem::path& case_folder, std::ostream& out);

}  // namespace dipper::cli
