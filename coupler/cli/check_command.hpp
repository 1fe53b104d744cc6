// `dipper check`.
#pragma once

#include "common/reporter.hpp"
#include "coupler/cli/command.hpp"

namespace dipper::cli {

Command add_check_command(CLI::App& app, Reporter& reporter);

}  // namespace dipper::cli
