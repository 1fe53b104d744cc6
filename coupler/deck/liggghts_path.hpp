// Paths that LIGGGHTS's input scripts can name.
#pragma once

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>

namespace dipper::deck {

/// Whether a path is safe in a LIGGGHTS script: letters, digits and the signs of the list, which
/// its parser, the shell and mpirun take literally. $, #, &, * and quotes have meanings there that
/// cannot be escaped. Blanks are allowed: scripts are given links (dem/work_folder.hpp).
inline bool liggghts_takes(const std::filesystem::path& path) {
  const std::string text = std::filesystem::absolute(path).string();
  return std::all_of(text.begin(), text.end(), [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte >= 0x80 || std::isalnum(byte) != 0 ||
           std::string(" /._-+=,:@~()").find(c) != std::string::npos;
  });
}

inline constexpr const char* kLiggghtsRefuses =
    "a path here takes letters, digits, blanks and / . _ - + = , : @ ~ ( ) only";

}  // namespace dipper::deck
