// dipper preview: a case in three dimensions before anything is computed.
#pragma once

#include <filesystem>

#include "common/reporter.hpp"
#include "coupler/cli/command.hpp"
#include "coupler/dry/dry_run.hpp"

namespace dipper::cli {

/// A dry run of a sound case, in windows as long as the machine alone allows; keeps only the page.
/// Reports as the run does, and the page's name. Returns the exit status.
int write_dry_page(cases::Case c, dry::RockModel rock, const std::filesystem::path& page,
                   Reporter& reporter);

Command add_preview_command(CLI::App& app, Reporter& reporter);

}  // namespace dipper::cli
