// `dipper observe`.
#pragma once

#include "coupler/cli/command.hpp"

namespace dipper::cli {

Command add_observe_command(CLI::App& app);

}  // namespace dipper::cli
