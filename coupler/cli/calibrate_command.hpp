// `dipper calibrate`.
#pragma once

#include "common/reporter.hpp"
#include "coupler/cli/command.hpp"

namespace dipper::cli {

Command add_calibrate_command(CLI::App& app, Reporter& reporter);

}  // namespace dipper::cli
