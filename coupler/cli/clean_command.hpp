// dipper clean: what a run or the cache holds on disk, and room again.
#pragma once

#include "common/reporter.hpp"
#include "coupler/cli/command.hpp"

namespace dipper::cli {

Command add_clean_command(CLI::App& app, Reporter& reporter);

}  // namespace dipper::cli
