#pragma once

#include <filesystem>

namespace dipper {

/// Where settled piles and fitted rock shapes are kept: $XDG_CACHE_HOME/dipper, else
/// ~/.cache/dipper.
std::filesystem::path cache_folder();

}  // namespace dipper
