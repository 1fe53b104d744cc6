// A small file that is written at once.
#pragma once

#include <filesystem>
#include <string>

namespace dipper {

/// Writes the file as these bytes, in place of what it held. Throws std::runtime_error naming it
/// when it cannot be written to the end.
void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace dipper
