// The folder LIGGGHTS works in.
#pragma once

#include <mpi.h>

#include <filesystem>

#include "coupler/setup/rock_setup.hpp"

namespace dipper::dem {

/// Makes a new `folder` the working one, with a link in it for each absolute path among the
/// set-up's variables, which then names the link instead, and a link dem_in to the folder of the
/// deck. Scripts of LIGGGHTS end a word at a blank and give $, #, & and quotes meanings that
/// nothing escapes: with links they read none of the paths a user has chosen. Collective.
setup::RockSetup enter_work_folder(setup::RockSetup setup, const std::filesystem::path& folder,
                                   MPI_Comm comm);

}  // namespace dipper::dem
