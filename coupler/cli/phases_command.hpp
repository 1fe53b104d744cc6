#pragma once

#include <iosfwd>
#include <string>

namespace dipper::cli {

/// Writes the passes and phases of a run's folder as JSON, or, for "-", the phases of readings that
/// `in` holds as JSON; docs/metrics.md has both formats. Returns the exit status: 0, or 2 with the
/// reason on stderr and nothing written.
int phases_command(const std::string& folder, std::istream& in, std::ostream& out);

}  // namespace dipper::cli
