// dipper preview: a case in three dimensions before anything is computed.
#pragma once

#include "common/reporter.hpp"
#include "coupler/cli/command.hpp"

namespace dipper::cli {

Command add_preview_command(CLI::App& app, Reporter& reporter);

}  // namespace dipper::cli
