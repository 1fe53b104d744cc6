// `dipper effects`.
#pragma once

#include <filesystem>

#include "common/reporter.hpp"
#include "coupler/cli/command.hpp"

namespace dipper::cli {

/// Writes the effects a case can take, the catalogue's and its own, as JSON; docs/case.md has the
/// format. Returns the exit status: 0, or 2 after reporting every fault of their files, with
/// nothing written.
int effects_command(const std::filesystem::path& case_folder, Reporter& reporter);

Command add_effects_command(CLI::App& app, Reporter& reporter);

}  // namespace dipper::cli
