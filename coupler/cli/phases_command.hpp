// `dipper phases`.
#pragma once

#include <iosfwd>
#include <string>

#include "common/reporter.hpp"
#include "coupler/cli/command.hpp"

namespace dipper::cli {

/// Writes the passes and phases of a run's folder as JSON, or, for "-", the phases of readings that
/// `in` holds as JSON; docs/metrics.md has both formats. Returns the exit status: 0, or 2 after
/// reporting the reason, with nothing written.
int phases_command(const std::string& folder, std::istream& in, Reporter& reporter);

Command add_phases_command(CLI::App& app, Reporter& reporter);

}  // namespace dipper::cli
