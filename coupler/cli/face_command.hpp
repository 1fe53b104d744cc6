// dipper face: the surface a run's dipper stands before, for the plan of the next pass.
#pragma once

#include "common/reporter.hpp"
#include "coupler/cli/command.hpp"

namespace dipper::cli {

Command add_face_command(CLI::App& app, Reporter& reporter);

}  // namespace dipper::cli
