// Completion for the shell and a page for `man`, made from the options themselves.
#pragma once

#include <string>
#include <vector>

#include "common/reporter.hpp"
#include "coupler/cli/command.hpp"

namespace dipper::cli {

/// The commands that help lists, in its order: without those that other programs call.
std::vector<const CLI::App*> listed_commands(const CLI::App& app);

/// A script for bash that completes commands and options, and file names in all other places.
std::string bash_completion(const CLI::App& app);

/// The manual page, in roff's man macros.
std::string manual_page(const CLI::App& app);

/// `dipper completion`: prints the script, or with --man the page. `app` has every other command by
/// the time it runs.
Command add_completion_command(CLI::App& app, Reporter& reporter);

}  // namespace dipper::cli
