// dipper clean: lists what a run or the cache takes on disk, and frees it.
#pragma once

#include "common/reporter.hpp"
#include "coupler/cli/command.hpp"

namespace dipper::cli {

Command add_clean_command(CLI::App& app, Reporter& reporter);

}  // namespace dipper::cli
