// What Dipper takes from the environment.
#pragma once

#include <string>

namespace dipper::cli {

/// Sets the cache's folder, $XDG_CACHE_HOME/dipper, else $HOME/.cache/dipper, else none; and that
/// of Dipper's own files, where $DIPPER_DATA names it. Removes the variables of an mpirun that
/// started this program; throws InputError when it has started several.
void read_environment();

/// Removes the variables whose names begin so.
void unset_variables(const std::string& start);

}  // namespace dipper::cli
