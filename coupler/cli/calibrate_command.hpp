// `dipper calibrate`: its words on the command line.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace dipper::cli {

/// Adds the subcommand. The function runs it once the line is parsed, and returns the exit status;
/// it throws CLI::ValidationError for words that parse but say nothing sensible.
std::function<int()> add_calibrate_command(CLI::App& app);

}  // namespace dipper::cli
