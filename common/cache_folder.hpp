#pragma once

#include <filesystem>

namespace dipper {

/// The folder of settled piles, calibrations and fitted rock shapes, as set by the program's main.
/// Throws InputError when none was set.
std::filesystem::path cache_folder();
void set_cache_folder(const std::filesystem::path& folder);

}  // namespace dipper
