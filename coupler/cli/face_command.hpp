// dipper face: the surface of the rock in front of a run's dipper, to plan the next pass.
#pragma once

#include "common/reporter.hpp"
#include "coupler/cli/command.hpp"

namespace dipper::cli {

Command add_face_command(CLI::App& app, Reporter& reporter);

}  // namespace dipper::cli
