// What LIGGGHTS's input scripts can name.
#pragma once

#include <filesystem>
#include <string>

namespace dipper::deck {

/// Whether a script can name the file: words end at blanks, and $, #, & and quotes have meanings of
/// their own that no escape takes away from a variable's value.
inline bool liggghts_takes(const std::filesystem::path& path) {
  return std::filesystem::absolute(path).string().find_first_of(" \t\n$#&\"'") == std::string::npos;
}

inline constexpr const char* kLiggghtsRefuses =
    "LIGGGHTS takes no path with a blank, a quote, $, # or &";

}  // namespace dipper::deck
