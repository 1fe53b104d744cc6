#pragma once

#include <filesystem>
#include <string>

namespace dipper {

/// A program of ours: beside this one.
std::string program(const std::string& name);

/// The source tree's root, for decks in dem_in/: compiled in.
std::filesystem::path source_folder();

/// Where settled piles are kept: $XDG_CACHE_HOME/dipper, else ~/.cache/dipper.
std::filesystem::path cache_folder();

/// "0.1.0".
std::string version();

}  // namespace dipper
