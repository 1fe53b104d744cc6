// A text file that is written whole or not at all.
#pragma once

#include <filesystem>
#include <string>

namespace dipper {

/// Replaces the file's contents by these bytes. Throws std::runtime_error naming the file when they
/// cannot be written to the end; the old contents then remain.
void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace dipper
