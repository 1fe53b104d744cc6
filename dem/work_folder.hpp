// LIGGGHTS's working folder.
#pragma once

#include <mpi.h>

#include <filesystem>

#include "coupler/setup/rock_setup.hpp"

namespace dipper::dem {

/// Makes a new `folder` the working one, with a link in it for each absolute path among the
/// set-up's variables, which then names the link instead, and a link dem_in to the folder of the
/// deck. LIGGGHTS splits the words of scripts at blanks, and $, #, & and quotes have meanings
/// that cannot be escaped: with links, scripts contain none of a user's paths. Collective.
setup::RockSetup enter_work_folder(setup::RockSetup setup, const std::filesystem::path& folder,
                                   MPI_Comm comm);

}  // namespace dipper::dem
