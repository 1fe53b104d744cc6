// dipper motion: motion.csv from a plan.
#pragma once

#include "common/reporter.hpp"
#include "coupler/cli/command.hpp"

namespace dipper::cli {

Command add_motion_command(CLI::App& app, Reporter& reporter);

}  // namespace dipper::cli
