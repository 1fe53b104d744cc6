#pragma once

#include <filesystem>

namespace dipper {

/// Where settled piles, calibrations and fitted rock shapes are kept: what the program's main has
/// set. Throws InputError where it has set none.
std::filesystem::path cache_folder();
void set_cache_folder(const std::filesystem::path& folder);

}  // namespace dipper
