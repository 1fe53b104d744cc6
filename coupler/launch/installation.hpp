#pragma once

#include <filesystem>
#include <string>

namespace dipper::launch {

/// A program of ours: beside this one.
std::string program(const std::string& name);

/// The source tree's root, for decks in dem_in/: compiled in.
std::filesystem::path source_folder();

/// "0.1.0".
std::string version();

}  // namespace dipper::launch
